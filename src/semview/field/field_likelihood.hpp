// SPDX-License-Identifier: Apache-2.0
/// The likelihood of a depth image with labels at many poses: Gomez et al. 2023, section 3.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/field/distance_field.hpp"
#include "semview/field/field_model.hpp"
#include "semview/field/slice_gather.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/view/voxel_list.hpp"

namespace semview::field {

/// How unlikely an observation is at each pose, in integers.
struct FieldScores {
  std::vector<std::int64_t> losses;  ///< -log p of all pixels in units of 1 / kUnitsPerNat
  std::int64_t pixels = 0;           ///< that count; see `FieldCue::kSem`

  /// The mean over pixels of the logarithm of equation (3), in [-8, 0].
  double mean_log_likelihood(std::size_t pose) const;
  /// The logarithm of a particle's weight, equation (2), tempered as configured.
  double log_weight(const FieldModelConfig& config, std::size_t pose) const;
};

/// An observation made ready for one likelihood.
///
/// @threads Const members from several threads at once.
class FieldObservation {
 public:
  /// That count; see `FieldCue::kSem`.
  std::int64_t pixels() const { return pixels_; }

 private:
  friend class FieldLikelihood;

  /// Voxels that one slice serves, for at most `kMaxPixelsAtOnce` pixels.
  struct SliceTask {
    std::shared_ptr<const LossSlice> slice;
    std::vector<SliceVoxel> voxels;
  };

  std::vector<SliceTask> tasks_;
  std::int64_t pixels_ = 0;
};

/// Scores poses by where the observed points of each class come to lie in the map.
///
/// Differs from the paper's pixel by pixel: points are counted into voxels first, each taken at its
/// centre; distances are looked up in cells. The logarithm of equation (3) depends on the class,
/// the height, which no pose changes, and two coordinates; for each class and height that occur it
/// is tabulated once a map as a slice, and kept.
///
/// @threads `prepare` and `score` of what it made from several threads at once; `set_observation`
/// from one at a time and not beside the `score` without an observation.
class FieldLikelihood {
 public:
  /// @param max_slice_bytes  Slices kept at most; those of earlier observations are dropped first.
  /// @errors as `validate`
  static Result<FieldLikelihood> make(std::shared_ptr<const DistanceField> field,
                                      FieldModelConfig config,
                                      std::size_t max_slice_bytes = kMaxSliceBytes);

  const FieldModelConfig& config() const { return config_; }

  /// Takes classes by name; one that the map does not have is of the class `kNoHit`.
  /// @errors kInvalidArgument: a voxel size that is not in [0.01, 1] m, or no pixel that counts;
  /// kResourceExhausted: slices of more than the bytes to keep.
  /// @cost What is new takes some ms a class and layer; later observations find it.
  Result<std::shared_ptr<const FieldObservation>> prepare(const VoxelList& voxels,
                                                          ThreadPool& pool) const;

  /// @errors kInvalidArgument: a pose is not finite.
  /// @cost O(poses · voxels), two additions and a gather each
  Result<FieldScores> score(const FieldObservation& observation,
                            std::span<const Pose2> map_from_base,
                            ThreadPool& pool) const;

  /// Prepares the observation that the other `score` takes. @errors as `prepare`
  Status set_observation(const VoxelList& voxels, ThreadPool& pool);
  /// @errors kFailedPrecondition: no observation; kInvalidArgument: a pose is not finite.
  Result<FieldScores> score(std::span<const Pose2> map_from_base, ThreadPool& pool) const;

  static constexpr std::size_t kMaxSliceBytes = std::size_t{1} << 30;

 private:
  using SliceKey = std::pair<double, ClassId>;  // height in frame `map`, the map's class

  using WantedSlices = std::map<SliceKey, std::vector<SliceVoxel>>;

  /// What is shared by all who prepare.
  struct Slices {
    std::mutex mutex;
    std::map<SliceKey, std::shared_ptr<const LossSlice>> by_key;
  };

  FieldLikelihood(std::shared_ptr<const DistanceField> field,
                  FieldModelConfig config,
                  std::size_t max_slice_bytes)
      : field_(std::move(field)), config_(std::move(config)), max_slice_bytes_(max_slice_bytes) {}

  WantedSlices by_slice(const VoxelList& voxels) const;
  Status make_room(const WantedSlices& wanted) const;
  void make_slices(const std::vector<SliceKey>& keys, ThreadPool& pool) const;
  /// Those of one height.
  std::vector<LossSlice> make_slices_at(double z_m, std::span<const SliceKey> keys) const;
  PoseLanes lanes_of(std::span<const Pose2> map_from_base) const;

  std::shared_ptr<const DistanceField> field_;
  FieldModelConfig config_;
  std::size_t max_slice_bytes_ = kMaxSliceBytes;
  std::unique_ptr<Slices> slices_ = std::make_unique<Slices>();
  std::shared_ptr<const FieldObservation> observation_;
};

}  // namespace semview::field
