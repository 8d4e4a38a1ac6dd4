// SPDX-License-Identifier: Apache-2.0
#include "sketch_drives.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "guard.hpp"
#include "hand_matrix.hpp"
#include "learned_weights.hpp"
#include "plan_drawing.hpp"
#include "row_map.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/io/output_path.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "sketch_units.hpp"
#include "trial.hpp"
#include "unit.hpp"

namespace semview::paper2017 {
namespace {

/// Sketches a world, in `SketchSettings`.
constexpr int kMaxSketches = 100;

Result<std::vector<Method>> methods_of(const SketchSettings& settings) {
  if (settings.methods.empty()) return sketch_methods();
  std::vector<Method> methods;
  for (const std::string& id : settings.methods) {
    const auto found = std::ranges::find(sketch_methods(), id, &Method::id);
    if (found == sketch_methods().end()) {
      std::string known;
      for (const Method& one : sketch_methods()) known += (known.empty() ? "" : ", ") + one.id;
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("--methods {}: expected some of {}", id, known),
                        "--methods"});
    }
    methods.push_back(*found);
  }
  return methods;
}

std::uint64_t sketch_seed(const SketchSettings& settings, std::uint64_t world, int number) {
  return settings.seed * 1'000'003 + world * 1009 + static_cast<std::uint64_t>(number);
}

std::filesystem::path plan_directory(const SketchSettings& settings,
                                     std::uint64_t world,
                                     int number,
                                     bool stacked) {
  return settings.out / "plans" /
         fmt::format("world_{}_sketch_{}{}", world, number, stacked ? "_stacked" : "");
}

struct Weights {
  similarity::WeightMatrix hand;
  std::optional<similarity::WeightMatrix> learned;
};

/// A sketch, one way of drawing it, and the world as it looks from there.
class SketchMap {
 public:
  static Result<SketchMap> open(const Sketch& sketch,
                                const World& world,
                                bool stacked,
                                std::uint64_t seed,
                                const std::filesystem::path& directory,
                                const std::string& engine) {
    SEMVIEW_TRY_STATUS(draw_plan(sketch.drawn, {.stacked = stacked}, seed, directory));
    SEMVIEW_TRY(map::SemanticMap drawn, map::load_map(directory));
    const service::SiteConfig config = site_config(engine);
    SEMVIEW_TRY(service::SharedTiers tiers, service::SharedTiers::open(config));
    SketchMap made;
    SEMVIEW_TRY(made.site_, service::Site::of(std::move(drawn), config, std::move(tiers)));
    made.world_ = cut_world(world, *find_row("unmodified"), made.site_->profile().camera);
    made.world_.free_cells = made.site_->cells().free_cells();
    made.world_.map_classes = made.site_->map().classes;
    for (Pose2& place : made.world_.truth) place = sketch.sketch_from_true(place);
    return made;
  }

  const RowWorld& world() const { return world_; }
  ViewSource& views() const { return site_->views(); }

 private:
  std::shared_ptr<service::Site> site_;
  RowWorld world_;
};

std::vector<SketchStop> stops_of(const Sketch& sketch,
                                 const RowWorld& world,
                                 const std::vector<Pose2>& estimates) {
  std::vector<SketchStop> stops;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    SketchStop stop;
    stop.true_place = world.truth[i];
    stop.true_room = room_of(sketch.drawn.rooms, stop.true_place);
    stop.estimate = estimates[i];
    stop.found_room = room_of(sketch.drawn.rooms, stop.estimate);
    stops.push_back(stop);
  }
  return stops;
}

std::vector<Pose2> odometry_alone(const RowWorld& world) {
  std::vector<Pose2> estimates;
  const Pose2 map_from_odom = world.truth.front() * inverse(world.odometry.front());
  for (const Pose2& pose : world.odometry) estimates.push_back(map_from_odom * pose);
  return estimates;
}

/// What all sketches share.
struct Common {
  const SketchSettings& settings;
  std::vector<Method> methods;
  Weights weights;
};

Result<Weights> load_weights(const SketchSettings& settings, ThreadPool& pool) {
  SEMVIEW_TRY(similarity::WeightMatrix hand,
              similarity::parse_weight_matrix(kHandMatrix, "the built-in matrix"));
  Weights weights{std::move(hand), std::nullopt};
  SEMVIEW_TRY(weights.learned,
              learn_weights(make_training_worlds(settings.world, pool),
                            ClassSubset::kAll,
                            Method().bands,
                            settings.out / "plans",
                            settings.engine));
  return weights;
}

/// A robot's drives on one sketch with one method.
/// @param drive  what they share; `start`, `run` and `stops` are set here
Status drive_method(const Common& common,
                    const Method& method,
                    const Sketch& sketch,
                    const SketchMap& map,
                    SketchDrive drive,
                    std::vector<SketchDrive>& drives) {
  ThreadPool alone(1);
  const similarity::WeightMatrix& weights =
      method.weights == WeightsKind::kLearned ? *common.weights.learned : common.weights.hand;
  const std::uint64_t seed = sketch_seed(common.settings, drive.world, drive.sketch);
  drive.method = method.id;
  for (const Start start : common.settings.starts) {
    drive.start = start;
    for (drive.run = 1; drive.run <= common.settings.runs; ++drive.run) {
      SEMVIEW_TRY(const std::vector<StopRecord> records,
                  run_trial(map.world(),
                            method,
                            start,
                            weights,
                            map.views(),
                            alone,
                            filter_seed(seed, drive.run)));
      std::vector<Pose2> estimates;
      for (const StopRecord& record : records) estimates.push_back(record.map_from_robot);
      drive.stops = stops_of(sketch, map.world(), estimates);
      drives.push_back(drive);
    }
  }
  return {};
}

Result<std::vector<SketchDrive>> drive_sketch(const Common& common,
                                              std::uint64_t world_seed,
                                              int number) {
  const SketchSettings& settings = common.settings;
  const World world = make_world(settings.world, WorldSeeds::all(world_seed));
  const Sketch sketch = sketch_of(settings, world, world_seed, number);
  SketchDrive drive;
  drive.world = world_seed;
  drive.sketch = number;
  std::vector<SketchDrive> drives;
  std::optional<SketchMap> maps[2];  // as the paper has it, stacked
  for (const Method& method : common.methods) {
    std::optional<SketchMap>& map = maps[method.stacked_plan ? 1 : 0];
    if (!map) {
      SEMVIEW_TRY(map,
                  SketchMap::open(sketch,
                                  world,
                                  method.stacked_plan,
                                  sketch_seed(settings, world_seed, number),
                                  plan_directory(settings, world_seed, number, method.stacked_plan),
                                  settings.engine));
    }
    SEMVIEW_TRY_STATUS(drive_method(common, method, sketch, *map, drive, drives));
  }
  const RowWorld& seen = (maps[0] ? maps[0] : maps[1])->world();
  drive.method = kOdometryAlone;
  drive.stops = stops_of(sketch, seen, odometry_alone(seen));
  drives.push_back(drive);
  return drives;
}

}  // namespace

bool in_right_order(const SketchDrive& drive) {
  const auto sequence = [&](std::size_t SketchStop::*room) {
    std::vector<std::size_t> rooms;
    for (const SketchStop& stop : drive.stops) {
      if (rooms.empty() || rooms.back() != stop.*room) rooms.push_back(stop.*room);
    }
    return rooms;
  };
  return sequence(&SketchStop::found_room) == sequence(&SketchStop::true_room);
}

Status validate(const SketchSettings& settings) {
  const auto refuse = [](const char* option, std::string message) {
    return fail(Error{ErrorCode::kInvalidArgument, std::move(message), option});
  };
  if (settings.sketches < 1 || settings.sketches > kMaxSketches) {
    return refuse("--sketches",
                  fmt::format("--sketches {}: expected 1 to {}", settings.sketches, kMaxSketches));
  }
  if (settings.runs < 1 || settings.runs > 1000) {
    return refuse("--runs", fmt::format("--runs {}: expected 1 to 1000", settings.runs));
  }
  SEMVIEW_TRY_STATUS(check_starts(settings.starts));
  SEMVIEW_TRY_STATUS(check_each_once("--methods", settings.methods));
  if (settings.out.empty()) return refuse("--out", "--out: expected a folder");
  if (const auto methods = methods_of(settings); !methods) return fail(methods.error());
  if (const auto use = check_worlds(settings.worlds); !use) return fail(use.error());
  return service::validate(site_config(settings.engine));
}

std::string describe(const SketchSettings& settings) {
  const SketchConfig& sketch = settings.sketch;
  std::string text = fmt::format("format: 1\nengine: {}\nruns: {}, seed {}\nstarts:",
                                 settings.engine,
                                 settings.runs,
                                 settings.seed);
  for (const Start start : settings.starts) text += fmt::format(" {}", name(start));
  text += fmt::format(
      "\nsketches: rooms by {} to {}, ends of walls {} to {} m, walls missing {}, furniture "
      "missing "
      "{}, swapped {}\n",
      sketch.least_factor,
      sketch.most_factor,
      sketch.least_end_m,
      sketch.most_end_m,
      sketch.missing_walls,
      sketch.missing_furniture,
      sketch.swapped_furniture);
  text += describe(settings.world);
  if (const auto methods = methods_of(settings)) {
    for (const Method& method : *methods) text += describe(method) + '\n';
  }
  return text;
}

Sketch sketch_of(const SketchSettings& settings,
                 const World& world,
                 std::uint64_t seed,
                 int number) {
  return draw_sketch(world.layout, settings.sketch, sketch_seed(settings, seed, number));
}

Result<std::vector<SketchDrive>> drive_sketches(
    const SketchSettings& settings, const std::function<void(std::size_t, std::size_t)>& progress) {
  SEMVIEW_TRY_STATUS(validate(settings));
  SEMVIEW_TRY_STATUS(io::check_output_folder(settings.out));
  SEMVIEW_TRY(const SketchUnits sketches, SketchUnits::open(settings, describe(settings)));
  std::vector<SketchUnits::Unit> left;
  std::ranges::copy_if(
      sketches.units(), std::back_inserter(left), [](const auto& unit) { return !unit.finished; });
  if (left.empty()) return sketches.read_all();
  SEMVIEW_TRY(std::vector<Method> methods, methods_of(settings));
  ThreadPool pool(settings.threads);
  SEMVIEW_TRY(Weights weights, load_weights(settings, pool));
  const Common common{settings, std::move(methods), std::move(weights)};
  std::mutex mutex;
  Status first_error;
  std::size_t finished = sketches.units().size() - left.size();
  pool.parallel_for(left.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto drives = drive_sketch(common, left[i].world, left[i].sketch);
      Status kept = drives ? sketches.keep(left[i], *drives) : fail(drives.error());
      const std::lock_guard lock(mutex);
      if (!kept && first_error) first_error = std::move(kept);
      progress(++finished, sketches.units().size());
    }
  });
  SEMVIEW_TRY_STATUS(std::move(first_error));
  // From the files, finished now or earlier: tables cannot differ from what is stored.
  return sketches.read_all();
}

}  // namespace semview::paper2017
