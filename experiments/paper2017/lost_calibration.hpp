// SPDX-License-Identifier: Apache-2.0
/// How well a robot knows that it is lost: labelled stops, the regression learned from them, and
/// how far its probabilities can be believed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/observation/lost_probability.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::paper2017 {

/// An estimate farther than this from the truth is lost.
inline constexpr double kLostBeyond_m = 1.0;
/// A robot that is lost with a higher probability is said to be lost.
inline constexpr double kAlarm = 0.5;

/// How a drive goes.
enum class Situation {
  kKnownStart,
  kWrongStart,  ///< the start that is believed is more than 3 m off
  kGlobal,      ///< the start is unknown
  kKidnapped,   ///< at one stop the robot is carried more than 3 m away, and odometry tells nothing
};

/// "known", "wrong", "global" or "kidnapped".
std::string_view name(Situation situation);

/// One stop of a drive.
struct LostStop {
  std::uint64_t world = 0;
  double noise_level = 0.0;
  Situation situation = Situation::kKnownStart;
  int run = 0;
  int stop = 0;  ///< from 1
  int since_kidnap =
      0;  ///< observations since the robot was carried away, this one included; 0: none
  double error_m = 0.0;
  observation::LostFeatures features;

  bool lost() const { return error_m > kLostBeyond_m; }
};

struct LostSettings {
  std::vector<std::uint64_t> worlds;
  std::vector<double> noise_levels;  ///< of `LabelNoiseConfig`
  int runs = 1;                      ///< of each situation and heading strategy
  std::uint64_t seed = 1;
  std::filesystem::path plans;  ///< where the worlds' plans are drawn
  similarity::WeightMatrix weights;
};

/// Drives through every world in every situation, with each heading strategy, as `semview localize`
/// does with its defaults. Equal settings give equal stops for any number of threads.
/// @errors those of drawing and opening maps and of scoring.
Result<std::vector<LostStop>> drive_all(const LostSettings& settings, ThreadPool& pool);

/// The logistic regression of highest likelihood, with a slight pull of the weights towards 0.
observation::LostModel fit_lost_model(std::span<const LostStop> stops);

/// Stops whose probabilities lie in one tenth.
struct ReliabilityBin {
  std::size_t stops = 0;
  double mean_probability = 0.0;
  double lost_share = 0.0;
};

struct LostQuality {
  std::vector<ReliabilityBin> bins;  ///< ten
  double calibration_error = 0.0;    ///< Σ stops/all · |mean_probability - lost_share|
  std::size_t stops = 0;
  std::size_t lost = 0;
  std::size_t kidnaps = 0;  ///< of which the robot was lost after
  std::size_t flagged = 0;  ///< with an alarm at the first or the second observation after
  std::size_t good = 0;     ///< stops that were not lost
  std::size_t false_alarms = 0;
};

LostQuality measure_quality(std::span<const LostStop> stops, const observation::LostModel& model);

/// A reliability diagram.
std::string reliability_svg(const LostQuality& quality, const std::string& title);

/// One line a stop.
std::string lost_stops_csv(std::span<const LostStop> stops, const observation::LostModel& model);

}  // namespace semview::paper2017
