// SPDX-License-Identifier: Apache-2.0
/// Robots in the true building, localized on sketches of it: which room do they think they are in?
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "methods.hpp"
#include "semview/core/result.hpp"
#include "sketch.hpp"
#include "world.hpp"

namespace semview::paper2017 {

struct SketchSettings {
  std::vector<std::uint64_t> worlds = {1, 2, 3, 4, 5, 6};
  int sketches = 3;                  ///< drawn of each world, in 1..100
  int runs = 2;                      ///< filter seeds a sketch, in 1..1000
  std::uint64_t seed = 1;            ///< of sketches and filters
  std::size_t threads = 0;           ///< 0: one a core
  std::string engine = "auto";       ///< what casts the sketch's views
  std::vector<std::string> methods;  ///< ids of `sketch_methods`; none: all
  std::vector<Start> starts = {Start::kLocal, Start::kGlobal};
  bool resume = false;  ///< keep what is finished in `out`
  std::filesystem::path out;
  WorldConfig world;
  SketchConfig sketch;
};

/// What is compared on sketches: the paper's weighted matrix; ours without, with one and with a
/// local distortion of the map in the state.
const std::vector<Method>& sketch_methods();

/// Odometry alone, put on the true start.
inline constexpr std::string_view kOdometryAlone = "odometry";

struct SketchStop {
  std::size_t true_room = kNoRoom;
  std::size_t found_room = kNoRoom;  ///< the sketch's room that holds the estimate
  Pose2 true_place;                  ///< of the robot, in the sketch
  Pose2 estimate;                    ///< in the sketch
};

struct SketchDrive {
  std::uint64_t world = 1;
  int sketch = 1;  ///< from 1
  std::string method;
  Start start = Start::kLocal;
  int run = 1;  ///< from 1
  std::vector<SketchStop> stops;
};

/// Whether the rooms that were found, repetitions taken out, are those that were visited, in their
/// order.
bool in_right_order(const SketchDrive& drive);

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const SketchSettings& settings);

/// All that a drive depends on but its world and the sketch's number, a line each.
std::string describe(const SketchSettings& settings);

/// The sketch of a world; numbers count from 1.
Sketch sketch_of(const SketchSettings& settings,
                 const World& world,
                 std::uint64_t seed,
                 int number);

/// All drives by worlds, sketches, methods (odometry last), starts, runs. Equal settings give equal
/// drives for any number of threads, resumed or not. Leaves `plans/` in `settings.out`, and a file
/// a sketch in `units/`, written when it is finished; drives are what stands there.
/// @param progress  called with the sketches that are done and all, by one thread at a time
/// @errors those of `validate` and `SketchUnits::open`, of drawing and opening maps and of scoring.
Result<std::vector<SketchDrive>> drive_sketches(
    const SketchSettings& settings, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace semview::paper2017
