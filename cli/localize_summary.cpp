// SPDX-License-Identifier: Apache-2.0
#include "localize_summary.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/localization/pose_estimate.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

nlohmann::ordered_json as_json(const robot::DenseStart& start) {
  nlohmann::ordered_json modes = nlohmann::ordered_json::array();
  for (const observation::PosteriorMode& mode : start.modes) {
    modes.push_back({{"x_m", mode.map_from_robot.x_m},
                     {"y_m", mode.map_from_robot.y_m},
                     {"yaw_deg", shown_deg(mode.map_from_robot.yaw_rad)},
                     {"probability", mode.probability},
                     {"similarity", mode.similarity}});
  }
  return {{"stamp_s", start.stamp_s}, {"cells", start.cells}, {"modes", std::move(modes)}};
}

nlohmann::ordered_json as_json(const localization::AffineEstimate& affine) {
  return {{"scale_x", affine.mean.a},
          {"scale_x_sigma", affine.a_sigma},
          {"scale_y", affine.mean.b},
          {"scale_y_sigma", affine.b_sigma},
          {"shear", affine.mean.k},
          {"shear_sigma", affine.k_sigma}};
}

void print_map(const localization::AffineEstimate& affine) {
  fmt::print(
      "map: drawn with scale x {:.3f} (sigma {:.3f}), y {:.3f} (sigma {:.3f}) and shear "
      "{:.3f} (sigma {:.3f})\n",
      affine.mean.a,
      affine.a_sigma,
      affine.mean.b,
      affine.b_sigma,
      affine.mean.k,
      affine.k_sigma);
}

void print_dense_start(const robot::DenseStart& start) {
  fmt::print("start: of {} cells at {} headings, the strongest places are\n",
             start.cells,
             PoseGrid::kHeadings);
  for (const observation::PosteriorMode& mode : start.modes) {
    fmt::print("  {:8.2f} {:8.2f} m  {:6.1f} deg  probability {:.3f}  similarity {:.3f}\n",
               mode.map_from_robot.x_m,
               mode.map_from_robot.y_m,
               deg_from_rad(mode.map_from_robot.yaw_rad),
               mode.probability,
               mode.similarity);
  }
}

/// How the frames of a drive went, together.
struct Counts {
  explicit Counts(const robot::Drive& drive) {
    for (const robot::FrameReport& frame : drive.frames) {
      scored += frame.state == robot::FrameState::kScored ? 1 : 0;
      stale += frame.state == robot::FrameState::kStale ? 1 : 0;
      unseen += frame.state == robot::FrameState::kUnseen ? 1 : 0;
      uninformative += frame.state == robot::FrameState::kUninformative ? 1 : 0;
      origins += frame.scores.origins;
    }
  }

  std::size_t scored = 0;
  std::size_t stale = 0;
  std::size_t unseen = 0;
  std::size_t uninformative = 0;
  ViewOrigins origins;
};

void print_json(const LocalizeOptions& options,
                const Scorer& scorer,
                const std::optional<robot::DenseStart>& start,
                const robot::Drive& drive) {
  const Counts counts(drive);
  const robot::FrameReport& last = drive.frames.back();
  const Pose2& pose = last.estimate.map_from_robot;
  const double sigma_m = localization::position_ellipse(last.estimate).major_sigma_m;
  nlohmann::ordered_json summary{{"estimate", options.output},
                                 {"engine", scorer.engine},
                                 {"engine_reason", scorer.engine_reason},
                                 {"weights", scorer.weights},
                                 {"frames", drive.frames.size()},
                                 {"scored", counts.scored},
                                 {"stale", counts.stale},
                                 {"unseen", counts.unseen},
                                 {"uninformative", counts.uninformative},
                                 {"without_odometry", drive.frames_without_odometry},
                                 {"cells",
                                  {{"memory", counts.origins.memory},
                                   {"disk", counts.origins.disk},
                                   {"cast", counts.origins.cast}}},
                                 {"last",
                                  {{"stamp_s", last.stamp_s},
                                   {"state", name(last.state)},
                                   {"x_m", pose.x_m},
                                   {"y_m", pose.y_m},
                                   {"yaw_deg", shown_deg(pose.yaw_rad)},
                                   {"sigma_m", sigma_m},
                                   {"weight", last.estimate.weight}}}};
  nlohmann::ordered_json& json_of_last = summary["last"];
  if (last.lost_probability) json_of_last["lost_probability"] = *last.lost_probability;
  if (last.affine) json_of_last["map"] = as_json(*last.affine);
  if (start) summary["start"] = as_json(*start);
  fmt::print("{}\n", summary.dump(2));
}

void print_text(const LocalizeOptions& options,
                const Scorer& scorer,
                const std::optional<robot::DenseStart>& start,
                const robot::Drive& drive) {
  const Counts counts(drive);
  const robot::FrameReport& last = drive.frames.back();
  const Pose2& pose = last.estimate.map_from_robot;
  const double sigma_m = localization::position_ellipse(last.estimate).major_sigma_m;
  if (start) print_dense_start(*start);
  if (last.affine) print_map(*last.affine);
  fmt::print(
      "{}: {} frames, {} scored, {} stale{}{}{}; ends at {:.2f} {:.2f} m, {:.1f} deg (sigma {:.2f} "
      "m around it, {:.0f} % of the belief{}); "
      "cells: {} memory, {} disk, {} cast; weights: {}\n",
      options.output,
      drive.frames.size(),
      counts.scored,
      counts.stale,
      counts.unseen > 0 ? fmt::format(", {} unseen", counts.unseen) : "",
      counts.uninformative > 0 ? fmt::format(", {} uninformative", counts.uninformative) : "",
      drive.frames_without_odometry > 0
          ? fmt::format(", {} more left out, without odometry", drive.frames_without_odometry)
          : "",
      pose.x_m,
      pose.y_m,
      deg_from_rad(pose.yaw_rad),
      sigma_m,
      100.0 * last.estimate.weight,
      last.lost_probability ? fmt::format("; lost with probability {:.2f}", *last.lost_probability)
                            : "",
      counts.origins.memory,
      counts.origins.disk,
      counts.origins.cast,
      scorer.weights);
}

}  // namespace

void print_localize_summary(const LocalizeOptions& options,
                            const Scorer& scorer,
                            const std::optional<robot::DenseStart>& start,
                            const robot::Drive& drive) {
  options.json ? print_json(options, scorer, start, drive)
               : print_text(options, scorer, start, drive);
}

}  // namespace semview::cli
