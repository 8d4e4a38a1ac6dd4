// SPDX-License-Identifier: Apache-2.0
/// Poses in order of how each takes the map to be distorted.
#pragma once

#include <cstdint>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::similarity {

/// The poses of one distortion, as a request of their own that has none.
struct AffineGroup {
  MapAffine affine;                   ///< on the grid of `kAffineStep`
  std::vector<std::uint32_t> places;  ///< of its poses in the whole request
  ScoreRequest request;
};

/// The groups of a request with affines, in order of their affines.
/// @errors kInvalidArgument, field `affines`: not one a pose, or one out of the ranges of
/// `MapAffine`.
Result<std::vector<AffineGroup>> group_by_affine(const ScoreRequest& request);

/// Puts a group's scores where its poses stand in the whole request, and adds its origins.
void put_scores(const ScoreBatch& scores, const AffineGroup& group, ScoreBatch& whole);

/// The views of one distortion as if there were no other.
class UndistortedViews final : public ViewSource {
 public:
  /// `source` must outlive this one.
  UndistortedViews(ViewSource& source, const MapAffine& affine)
      : source_(source), affine_(affine) {}

  const ViewProfile& profile() const override { return source_.profile(); }
  Result<ViewBatch> views(std::span<const CellIndex> cells) override {
    return source_.undistorted_views(cells, affine_);
  }

 private:
  ViewSource& source_;
  MapAffine affine_;
};

}  // namespace semview::similarity
