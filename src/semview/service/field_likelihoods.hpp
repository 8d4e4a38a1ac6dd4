// SPDX-License-Identifier: Apache-2.0
/// The models of depth images that are asked for on one map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "semview/core/result.hpp"
#include "semview/view/score_model.hpp"

namespace semview::field {
class DistanceField;
class FieldLikelihood;
}  // namespace semview::field

namespace semview::map {
struct SemanticMap;
}

namespace semview::service {

/// Made when they are first asked for, and kept with the slices that observations have needed: of
/// the `kKept` settings that were used last.
/// @threads All members from several threads at once.
class FieldLikelihoods {
 public:
  static constexpr std::size_t kKept = 3;
  static constexpr std::size_t kSliceBytes = std::size_t{512} << 20U;  ///< each

  /// @param map  outlives it
  explicit FieldLikelihoods(const map::SemanticMap& map);
  ~FieldLikelihoods();

  /// @errors those of `field::validate` and `field::distances_of_map`
  /// @cost The map's distances the first time: 0.1 s of a plan, seconds of a large volume.
  Result<std::shared_ptr<const field::FieldLikelihood>> of(const DepthScoring& scoring);

 private:
  using Kept = std::pair<DepthScoring, std::shared_ptr<const field::FieldLikelihood>>;

  const map::SemanticMap& map_;
  std::mutex mutex_;
  std::optional<Result<std::shared_ptr<const field::DistanceField>>> distances_;
  std::list<Kept> kept_;  // the one used last first
};

}  // namespace semview::service
