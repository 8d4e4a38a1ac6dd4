// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace semview::field {
namespace {

/// Far beyond any grid, and still a place that floats tell from its neighbours.
constexpr double kFarthest_cells = 1e6;

/// The map's class of each class of an observation; place 0 is not used.
std::vector<ClassId> map_labels_of(const ClassTable& observed, const ClassTable& map) {
  std::vector<ClassId> labels(static_cast<std::size_t>(kUnknown) + 1, kUnknown);
  for (int i = 0; i < observed.size(); ++i) {
    const auto name = observed.names()[static_cast<std::size_t>(i)];
    labels[static_cast<std::size_t>(i) + 1] = map.id(name).value_or(kNoHit);
  }
  return labels;
}

}  // namespace

double FieldScores::mean_log_likelihood(std::size_t pose) const {
  return -static_cast<double>(losses[pose]) /
         (static_cast<double>(kUnitsPerNat) * static_cast<double>(pixels));
}

double FieldScores::log_weight(const FieldModelConfig& config, std::size_t pose) const {
  return config.effective_pixels.value_or(static_cast<double>(pixels)) * mean_log_likelihood(pose);
}

Result<FieldLikelihood> FieldLikelihood::make(std::shared_ptr<const DistanceField> field,
                                              FieldModelConfig config,
                                              std::size_t max_slice_bytes) {
  SEMVIEW_TRY_STATUS(validate(config, field->classes().size()));
  return FieldLikelihood(std::move(field), std::move(config), max_slice_bytes);
}

Result<std::shared_ptr<const FieldObservation>> FieldLikelihood::prepare(const VoxelList& voxels,
                                                                         ThreadPool& pool) const {
  if (!(voxels.voxel_m >= 0.01 && voxels.voxel_m <= 1.0)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("observed voxels of {} m: expected 0.01 to 1", voxels.voxel_m));
  }
  const WantedSlices wanted = by_slice(voxels);
  if (wanted.empty()) {
    return fail(ErrorCode::kInvalidArgument, "the observation has no pixel that counts");
  }
  const std::lock_guard lock(slices_->mutex);
  SEMVIEW_TRY_STATUS(make_room(wanted));
  std::vector<SliceKey> missing;
  for (const auto& [key, unused] : wanted) {
    if (!slices_->by_key.contains(key)) missing.push_back(key);
  }
  make_slices(missing, pool);
  const auto observation = std::make_shared<FieldObservation>();
  for (const auto& [key, of_slice] : wanted) {
    const auto& slice = slices_->by_key.at(key);
    std::uint32_t room = 0;
    for (const SliceVoxel& voxel : of_slice) {
      for (auto left = static_cast<std::uint32_t>(voxel.count); left > 0;) {
        if (room == 0) {
          observation->tasks_.push_back({slice, {}});
          room = kMaxPixelsAtOnce;
        }
        const std::uint32_t taken = std::min(left, room);
        observation->tasks_.back().voxels.push_back(
            {voxel.x_cells, voxel.y_cells, static_cast<std::int32_t>(taken)});
        left -= taken;
        room -= taken;
      }
      observation->pixels_ += voxel.count;
    }
  }
  return observation;
}

Status FieldLikelihood::set_observation(const VoxelList& voxels, ThreadPool& pool) {
  observation_.reset();
  SEMVIEW_TRY(observation_, prepare(voxels, pool));
  return {};
}

Result<FieldScores> FieldLikelihood::score(std::span<const Pose2> map_from_base,
                                           ThreadPool& pool) const {
  if (!observation_) return fail(ErrorCode::kFailedPrecondition, "no observation set");
  return score(*observation_, map_from_base, pool);
}

Result<FieldScores> FieldLikelihood::score(const FieldObservation& observation,
                                           std::span<const Pose2> map_from_base,
                                           ThreadPool& pool) const {
  if (!std::ranges::all_of(map_from_base, [](const Pose2& pose) { return is_finite(pose); })) {
    return fail(ErrorCode::kInvalidArgument, "a pose is not finite");
  }
  const PoseLanes lanes = lanes_of(map_from_base);
  FieldScores scores;
  scores.losses.resize(lanes.x_cells.size());
  scores.pixels = observation.pixels_;
  // Each thread takes all slices in turn for its poses: a slice comes into its cache once.
  const std::size_t chunks = lanes.x_cells.size() / PoseLanes::kPad;
  const std::size_t grain = (chunks + pool.threads() - 1) / pool.threads();
  pool.parallel_for(
      chunks, std::max<std::size_t>(grain, 1), [&](std::size_t begin, std::size_t end) {
        for (const auto& task : observation.tasks_) {
          add_losses(*task.slice,
                     task.voxels,
                     lanes,
                     begin * PoseLanes::kPad,
                     end * PoseLanes::kPad,
                     scores.losses);
        }
      });
  scores.losses.resize(map_from_base.size());
  return scores;
}

FieldLikelihood::WantedSlices FieldLikelihood::by_slice(const VoxelList& voxels) const {
  const std::vector<ClassId> map_labels = map_labels_of(voxels.classes, field_->classes());
  const double cells_per_voxel = voxels.voxel_m / field_->grid().cell_m;
  WantedSlices wanted;
  for (const ObservedVoxel& voxel : voxels.voxels) {
    ClassId label = map_labels[voxel.label];
    if (config_.cue == FieldCue::kSem && label == kUnknown) continue;
    if (config_.cue == FieldCue::kSdf) label = kUnknown;
    if (voxel.count == 0) continue;
    const double z_m = field_->ground_height_m() + (voxel.z + 0.5) * voxels.voxel_m;
    constexpr auto kMost = static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max());
    wanted[{z_m, label}].push_back({static_cast<float>((voxel.x + 0.5) * cells_per_voxel),
                                    static_cast<float>((voxel.y + 0.5) * cells_per_voxel),
                                    static_cast<std::int32_t>(std::min(voxel.count, kMost))});
  }
  return wanted;
}

Status FieldLikelihood::make_room(const WantedSlices& wanted) const {
  const LayerGrid& grid = field_->grid();
  const std::size_t slice_bytes = LossSlice(grid.columns, grid.rows).bytes();
  const std::size_t most = max_slice_bytes_ / slice_bytes;
  if (wanted.size() > most) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("{} classes and layers of {} bytes each: expected at most {} bytes",
                            wanted.size(),
                            slice_bytes,
                            max_slice_bytes_));
  }
  std::size_t after = slices_->by_key.size();
  for (const auto& [key, unused] : wanted) after += slices_->by_key.contains(key) ? 0 : 1;
  for (auto slice = slices_->by_key.begin(); after > most && slice != slices_->by_key.end();) {
    if (wanted.contains(slice->first)) {
      ++slice;
    } else {
      slice = slices_->by_key.erase(slice);
      --after;
    }
  }
  return {};
}

void FieldLikelihood::make_slices(const std::vector<SliceKey>& keys, ThreadPool& pool) const {
  // Keys are sorted by height: one task each, since all classes there share the surface's
  // distances.
  std::vector<std::span<const SliceKey>> heights;
  for (std::size_t first = 0; first < keys.size();) {
    std::size_t past = first;
    while (past < keys.size() && keys[past].first == keys[first].first) ++past;
    heights.push_back(std::span(keys).subspan(first, past - first));
    first = past;
  }
  std::vector<std::vector<LossSlice>> made(heights.size());
  pool.parallel_for(heights.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      made[i] = make_slices_at(heights[i].front().first, heights[i]);
    }
  });
  for (std::size_t i = 0; i < heights.size(); ++i) {
    for (std::size_t k = 0; k < heights[i].size(); ++k) {
      slices_->by_key[heights[i][k]] = std::make_shared<const LossSlice>(std::move(made[i][k]));
    }
  }
}

std::vector<LossSlice> FieldLikelihood::make_slices_at(double z_m,
                                                       std::span<const SliceKey> keys) const {
  const LayerGrid& grid = field_->grid();
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> sdf_m2(grid.cells(), kFar);
  std::vector<float> class_m2(grid.cells(), kFar);
  if (config_.cue != FieldCue::kSem) field_->sample_surface(z_m, sdf_m2);
  std::vector<LossSlice> slices;
  for (const auto& [unused, label] : keys) {
    const CueWeights weights = cue_weights(config_, label);
    if (weights.z_sem > 0.0) field_->sample_class(label, z_m, class_m2);
    const PixelLoss loss(config_, weights);
    LossSlice& slice = slices.emplace_back(grid.columns, grid.rows);
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
      slice.set(cell, loss(sdf_m2[cell], class_m2[cell]));
    }
  }
  return slices;
}

PoseLanes FieldLikelihood::lanes_of(std::span<const Pose2> map_from_base) const {
  const LayerGrid& grid = field_->grid();
  const Pose2 grid_from_map = inverse(grid.map_from_grid);
  PoseLanes lanes(map_from_base.size());
  for (std::size_t i = 0; i < map_from_base.size(); ++i) {
    const Pose2 grid_from_base = grid_from_map * map_from_base[i];
    const auto in_cells = [&grid](double metres) {
      return static_cast<float>(
          std::clamp(metres / grid.cell_m, -kFarthest_cells, kFarthest_cells));
    };
    lanes.x_cells[i] = in_cells(grid_from_base.x_m);
    lanes.y_cells[i] = in_cells(grid_from_base.y_m);
    lanes.cos_yaw[i] = static_cast<float>(std::cos(grid_from_base.yaw_rad));
    lanes.sin_yaw[i] = static_cast<float>(std::sin(grid_from_base.yaw_rad));
  }
  return lanes;
}

}  // namespace semview::field
