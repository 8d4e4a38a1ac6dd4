// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/score_distorted.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/similarity/score_poses.hpp"

namespace semview::similarity {
namespace {

/// The views of one affine as if there were no other.
class UndistortedViews final : public ViewSource {
 public:
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

/// The answers of one group, put where its poses stand in the request.
void put(const ScoreBatch& from, const std::vector<std::size_t>& places, ScoreBatch& to) {
  constexpr auto kHeadings = static_cast<std::size_t>(PoseGrid::kHeadings);
  for (std::size_t i = 0; i < places.size(); ++i) {
    to.sums[places[i]] = from.sums[i];
    if (!from.best_heading.empty()) to.best_heading[places[i]] = from.best_heading[i];
    if (from.curve.empty()) continue;
    std::copy_n(from.curve.begin() + static_cast<std::ptrdiff_t>(i * kHeadings),
                kHeadings,
                to.curve.begin() + static_cast<std::ptrdiff_t>(places[i] * kHeadings));
  }
}

}  // namespace

Result<ScoreBatch> score_distorted(const PreparedObservation& observation,
                                   ViewSource& views,
                                   const ScoreRequest& request,
                                   ThreadPool& pool) {
  const std::size_t poses = request.poses.size();
  if (request.affines.size() != poses) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format(
            "{} affines of {} poses: expected one a pose, or none", request.affines.size(), poses),
        "affines"});
  }
  std::map<MapAffine, std::vector<std::size_t>> places_of;
  for (std::size_t i = 0; i < poses; ++i) {
    places_of[on_affine_grid(request.affines[i])].push_back(i);
  }
  const std::vector<std::pair<MapAffine, std::vector<std::size_t>>> groups(places_of.begin(),
                                                                           places_of.end());
  std::vector<std::optional<Result<ScoreBatch>>> answers(groups.size());
  pool.parallel_for(groups.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      ScoreRequest part;
      part.mode = request.mode;
      part.whole_curve = request.whole_curve;
      for (const std::size_t place : groups[g].second) part.poses.push_back(request.poses[place]);
      UndistortedViews undistorted(views, groups[g].first);
      answers[g] = score_poses(observation, undistorted, part, pool);
    }
  });

  const bool compass = request.mode == HeadingMode::kCompass;
  ScoreBatch batch;
  batch.weight_scale = observation.weight_scale();
  batch.observed_pixels = observation.observed_pixels();
  batch.sums.resize(poses);
  if (compass) batch.best_heading.resize(poses);
  if (request.whole_curve) batch.curve.resize(poses * PoseGrid::kHeadings);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    SEMVIEW_TRY(const ScoreBatch part, *std::move(answers[g]));
    put(part, groups[g].second, batch);
    batch.origins += part.origins;
  }
  return batch;
}

}  // namespace semview::similarity
