// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/affine_groups.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"

namespace semview::similarity {
namespace {

tl::unexpected<Error> wrong(std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), "affines"});
}

}  // namespace

Result<std::vector<AffineGroup>> group_by_affine(const ScoreRequest& request) {
  if (request.affines.size() != request.poses.size()) {
    return wrong(fmt::format("{} affines of {} poses: expected one a pose, or none",
                             request.affines.size(),
                             request.poses.size()));
  }
  std::map<MapAffine, std::vector<std::uint32_t>> places_of;
  for (std::size_t i = 0; i < request.affines.size(); ++i) {
    const MapAffine& affine = request.affines[i];
    if (!affine.in_range()) {
      return wrong(
          fmt::format("affine {} has a {:g}, b {:g}, k {:g}: expected scales of 0.2 to 5 and "
                      "a shear of -2 to 2",
                      i,
                      affine.a,
                      affine.b,
                      affine.k));
    }
    places_of[on_affine_grid(affine)].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<AffineGroup> groups;
  groups.reserve(places_of.size());
  for (auto& [affine, places] : places_of) {
    AffineGroup group{affine, std::move(places), {}};
    group.request.mode = request.mode;
    group.request.whole_curve = request.whole_curve;
    group.request.poses.reserve(group.places.size());
    for (const std::uint32_t place : group.places) {
      group.request.poses.push_back(request.poses[place]);
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

void put_scores(const ScoreBatch& scores, const AffineGroup& group, ScoreBatch& whole) {
  constexpr auto kHeadings = static_cast<std::size_t>(PoseGrid::kHeadings);
  for (std::size_t i = 0; i < group.places.size(); ++i) {
    const std::size_t place = group.places[i];
    whole.sums[place] = scores.sums[i];
    if (!scores.best_heading.empty()) whole.best_heading[place] = scores.best_heading[i];
    if (scores.curve.empty()) continue;
    std::copy_n(scores.curve.begin() + static_cast<std::ptrdiff_t>(i * kHeadings),
                kHeadings,
                whole.curve.begin() + static_cast<std::ptrdiff_t>(place * kHeadings));
  }
  whole.origins += scores.origins;
}

}  // namespace semview::similarity
