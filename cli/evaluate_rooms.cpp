// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate rooms`.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "evaluate_verbs.hpp"
#include "semview/evaluation/room_plan.hpp"
#include "semview/evaluation/run_metrics.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/trajectory.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string log;
  std::string true_rooms;
  std::string rooms;
  std::vector<std::string> estimates;
  bool start = false;
  bool json = false;
};

/// Truth and estimate at the stamps that the ground truth covers.
struct Places {
  std::vector<Pose2> truth;
  std::vector<Pose2> found;
};

Places paired(const std::vector<io::StampedPose2>& truth,
              const std::vector<io::StampedPose2>& estimate) {
  Places places;
  std::size_t next = 0;
  for (const io::StampedPose2& at : evaluation::sample(truth, estimate)) {
    while (estimate[next].stamp_s < at.stamp_s) ++next;
    places.truth.push_back(at.pose);
    places.found.push_back(estimate[next].pose);
  }
  return places;
}

/// Where the robot begins, in the sketch: what `localize --init` takes.
Status print_start(const Options& options,
                   const std::vector<evaluation::NamedRoom>& true_rooms,
                   const std::vector<evaluation::NamedRoom>& rooms,
                   const io::RunLog& log) {
  const std::vector<io::StampedPose2> first{{log.frames.front().stamp_s, {}}};
  const auto truth = evaluation::sample(*log.groundtruth, first);
  const auto moved = truth.empty()
                         ? std::nullopt
                         : evaluation::moved_with_room(true_rooms, rooms, truth.front().pose);
  if (!moved) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: begins in no room of both {} and {}",
                            options.log,
                            options.true_rooms,
                            options.rooms));
  }
  fmt::print("{:.3f},{:.3f},{:.2f}\n", moved->x_m, moved->y_m, deg_from_rad(moved->yaw_rad));
  return {};
}

bool share_a_name(const std::vector<evaluation::NamedRoom>& some,
                  const std::vector<evaluation::NamedRoom>& others) {
  return std::ranges::any_of(some, [&](const evaluation::NamedRoom& room) {
    return std::ranges::find(others, room.name, &evaluation::NamedRoom::name) != others.end();
  });
}

/// Where a pose was in no room, people read words.
std::vector<std::string> with_no_room(std::vector<std::string> order) {
  std::ranges::replace(order, "", "(no room)");
  return order;
}

void print(const std::string& file, const evaluation::RoomScore& score) {
  fmt::print("{}: in the right room {} of {} ({:.1f} %), {:.2f} m from its place there\n",
             file,
             score.right,
             score.places,
             100.0 * static_cast<double>(score.right) / static_cast<double>(score.places),
             score.mean_error_m);
  if (score.outside > 0) {
    fmt::print("  left out: {} of {} poses, which were in no room of the building\n",
               score.outside,
               score.places + score.outside);
  }
  const bool in_order = score.found_order == score.true_order;
  fmt::print("  rooms in the right order: {}\n", in_order ? "yes" : "no");
  fmt::print("  rooms visited: {}\n", fmt::join(score.true_order, ", "));
  if (!in_order)
    fmt::print("  rooms found:   {}\n", fmt::join(with_no_room(score.found_order), ", "));
}

ordered_json as_json(const std::string& file, const evaluation::RoomScore& score) {
  return {{"estimate", file},
          {"poses", score.places},
          {"outside_true_rooms", score.outside},
          {"in_right_room", score.right},
          {"mean_error_m", score.mean_error_m},
          {"in_right_order", score.found_order == score.true_order},
          {"rooms_visited", score.true_order},
          {"rooms_found", score.found_order}};
}

Status evaluate_rooms(const Options& options) {
  SEMVIEW_TRY(const auto true_rooms, evaluation::read_rooms(options.true_rooms));
  SEMVIEW_TRY(const auto rooms, evaluation::read_rooms(options.rooms));
  if (!share_a_name(true_rooms, rooms)) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{} and {}: have no room of the same name; rooms are joined by name",
                            options.true_rooms,
                            options.rooms));
  }
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(options.log));
  if (!log.groundtruth) {
    return fail(ErrorCode::kFailedPrecondition,
                fmt::format("{}: has no groundtruth.txt to compare with", options.log));
  }
  if (options.start) return print_start(options, true_rooms, rooms, log);
  ordered_json rows = ordered_json::array();
  for (const std::string& file : options.estimates) {
    SEMVIEW_TRY(const std::vector<io::StampedPose2> estimate, io::read_tum(file));
    const Places places = paired(*log.groundtruth, estimate);
    const evaluation::RoomScore score =
        evaluation::score_rooms(true_rooms, rooms, places.truth, places.found);
    if (score.places == 0) {
      return fail(ErrorCode::kOutOfRange,
                  fmt::format("{}: no pose lies in a room of {}", file, options.true_rooms));
    }
    if (options.json) {
      rows.push_back(as_json(file, score));
    } else {
      print(file, score);
    }
  }
  if (options.json) fmt::print("{}\n", ordered_json{{"estimates", std::move(rows)}}.dump(2));
  return {};
}

}  // namespace

void add_evaluate_rooms_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "rooms",
      "Estimated trajectories on a sketch of the building: how many poses are in the right room, "
      "and whether rooms come in the right order. Rooms are rectangles in CSV files, of the "
      "building in the ground truth's frame and of the sketch in its own, joined by name; where "
      "two overlap, the one listed first "
      "counts.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--log", options->log, "Folder of the run log, with ground truth")->required();
  verb->add_option("--true-rooms", options->true_rooms, "CSV file of the building's rooms")
      ->required();
  verb->add_option("--rooms", options->rooms, "CSV file of the sketch's rooms")->required();
  auto* estimates = verb->add_option("ESTIMATE", options->estimates, "est.tum files");
  auto* start = verb->add_flag("--start",
                               options->start,
                               "Instead: print where the log begins, in the sketch, as "
                               "X,Y,YAW_DEG for `localize --init`");
  start->excludes(estimates);
  verb->add_flag("--json", options->json, "Print JSON")->excludes(start);
  verb->footer(
      "Example: semview evaluate rooms --log run1 --true-rooms building.csv --rooms sketch.csv "
      "run1/est.tum");
  verb->callback([options, &exit_code] {
    if (options->estimates.empty() && !options->start) throw CLI::RequiredError("ESTIMATE");
    exit_code = report(evaluate_rooms(*options));
  });
}

}  // namespace semview::cli
