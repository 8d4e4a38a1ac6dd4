// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/score_wire.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/protocol/envelope.hpp"
#include "semview/protocol/view_wire.hpp"

namespace semview::protocol {

void to_wire(const Observation& observation, v1::SetObservationRequest* wire) {
  for (const std::string& name : observation.classes.names()) wire->add_class_names(name);
  wire->set_rows(static_cast<std::uint32_t>(observation.labels.rows()));
  wire->set_columns(static_cast<std::uint32_t>(observation.labels.columns()));
  wire->set_labels(to_bytes(observation.labels.pixels()));
  wire->set_stamp_s(observation.stamp_s);
}

Result<ClassTable> classes_from_wire(const v1::SetObservationRequest& wire) {
  if (wire.class_names_size() == 0 || wire.class_names_size() > kMaxClasses) {
    return wrong_field(
        "class_names",
        fmt::format("{} names; expected 1 to {}", wire.class_names_size(), kMaxClasses));
  }
  std::unordered_set<std::string> seen;
  for (const std::string& name : wire.class_names()) {
    if (name.empty() || !seen.insert(name).second) {
      return wrong_field("class_names", fmt::format("'{}' is empty or there twice", name));
    }
  }
  if (!std::isfinite(wire.stamp_s())) {
    return wrong_field("stamp_s",
                       fmt::format("{}; expected a finite number of seconds", wire.stamp_s()));
  }
  return ClassTable({wire.class_names().begin(), wire.class_names().end()});
}

Result<Observation> from_wire(const v1::SetObservationRequest& wire) {
  SEMVIEW_TRY(ClassTable classes, classes_from_wire(wire));
  SEMVIEW_TRY(LabelImage labels,
              labels_from_bytes(wire.labels(), wire.rows(), wire.columns(), "labels"));
  return Observation{std::move(classes), std::move(labels), wire.stamp_s()};
}

void to_wire(const ScoreRequest& request, v1::ScoreRequest* wire) {
  to_wire(std::span(request.poses), wire->mutable_poses());
  wire->set_mode(request.mode == HeadingMode::kCompass ? v1::HEADING_MODE_COMPASS
                                                       : v1::HEADING_MODE_AS_GIVEN);
  wire->set_whole_curve(request.whole_curve);
  for (const MapAffine& affine : request.affines) {
    const AffineSteps steps = affine_steps(affine);
    wire->mutable_affines()->add_a(steps.a);
    wire->mutable_affines()->add_b(steps.b);
    wire->mutable_affines()->add_k(steps.k);
  }
}

namespace {

Result<std::vector<MapAffine>> affines_from_wire(const v1::AffineSteps& wire, std::size_t poses) {
  const auto count = static_cast<std::size_t>(wire.a_size());
  if (wire.a_size() != wire.b_size() || wire.a_size() != wire.k_size() ||
      (count != 0 && count != poses)) {
    return wrong_field(
        "affines",
        fmt::format("{} a, {} b, {} k of {} poses; expected one each a pose, or none",
                    wire.a_size(),
                    wire.b_size(),
                    wire.k_size(),
                    poses));
  }
  std::vector<MapAffine> affines;
  affines.reserve(count);
  for (int i = 0; i < wire.a_size(); ++i) {
    const auto within = [](std::int32_t steps, int most) {
      return steps >= -most && steps <= most;
    };
    if (!within(wire.a(i), AffineSteps::kMostSteps) ||
        !within(wire.b(i), AffineSteps::kMostSteps) ||
        !within(wire.k(i), AffineSteps::kMostShearSteps)) {
      return wrong_field(
          "affines",
          fmt::format("entry {} is {}, {}, {} steps; expected a and b within {}, k within {}",
                      i,
                      wire.a(i),
                      wire.b(i),
                      wire.k(i),
                      AffineSteps::kMostSteps,
                      AffineSteps::kMostShearSteps));
    }
    affines.push_back(affine_of(AffineSteps{wire.a(i), wire.b(i), wire.k(i)}));
  }
  return affines;
}

}  // namespace

Result<ScoreRequest> from_wire(const v1::ScoreRequest& wire, std::size_t max_poses) {
  ScoreRequest request;
  switch (wire.mode()) {
    case v1::HEADING_MODE_UNSPECIFIED:
    case v1::HEADING_MODE_AS_GIVEN:
      break;
    case v1::HEADING_MODE_COMPASS:
      request.mode = HeadingMode::kCompass;
      break;
    default:
      return wrong_field("mode",
                         fmt::format("{} is not a heading mode", static_cast<int>(wire.mode())));
  }
  request.whole_curve = wire.whole_curve();
  if (request.whole_curve && request.mode != HeadingMode::kCompass) {
    return wrong_field("whole_curve", "only the compass has a curve");
  }
  SEMVIEW_TRY(request.poses, from_wire(wire.poses(), max_poses, "poses"));
  SEMVIEW_TRY(request.affines, affines_from_wire(wire.affines(), request.poses.size()));
  return request;
}

v1::ScoreReply to_wire(const ScoreBatch& batch) {
  v1::ScoreReply wire;
  wire.set_weight_scale(batch.weight_scale);
  wire.set_observed_pixels(batch.observed_pixels);
  wire.mutable_sums()->Add(batch.sums.begin(), batch.sums.end());
  wire.set_best_headings(to_bytes(batch.best_heading));
  wire.mutable_curve()->Add(batch.curve.begin(), batch.curve.end());
  *wire.mutable_origins() = to_wire(batch.origins);
  return wire;
}

Result<ScoreBatch> from_wire(const v1::ScoreReply& wire, const ScoreRequest& request) {
  const std::size_t poses = request.poses.size();
  const std::size_t headings = request.mode == HeadingMode::kCompass ? poses : 0;
  const std::size_t curve = request.whole_curve ? poses * PoseGrid::kHeadings : 0;
  const auto in_grid = [](char heading) {
    return static_cast<std::uint8_t>(heading) < PoseGrid::kHeadings;
  };
  if (static_cast<std::size_t>(wire.sums_size()) != poses ||
      wire.best_headings().size() != headings ||
      static_cast<std::size_t>(wire.curve_size()) != curve || wire.weight_scale() <= 0 ||
      wire.observed_pixels() <= 0 ||
      !std::all_of(wire.best_headings().begin(), wire.best_headings().end(), in_grid)) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("scores: {} sums, {} headings, scale {}, {} pixels; expected the "
                            "scores of {} poses",
                            wire.sums_size(),
                            wire.best_headings().size(),
                            wire.weight_scale(),
                            wire.observed_pixels(),
                            poses));
  }
  ScoreBatch batch;
  batch.weight_scale = wire.weight_scale();
  batch.observed_pixels = wire.observed_pixels();
  batch.sums.assign(wire.sums().begin(), wire.sums().end());
  batch.best_heading.assign(wire.best_headings().begin(), wire.best_headings().end());
  batch.curve.assign(wire.curve().begin(), wire.curve().end());
  batch.origins = from_wire(wire.origins());
  return batch;
}

}  // namespace semview::protocol
