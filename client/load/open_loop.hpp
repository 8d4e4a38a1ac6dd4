// SPDX-License-Identifier: Apache-2.0
/// Robots that begin a cycle at fixed times, whatever the answers do.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "client/load/load_report.hpp"
#include "semview/core/clock.hpp"
#include "semview/core/result.hpp"

namespace semview::client {

struct LoadConfig {
  std::size_t robots = 1;                   ///< 1 to `kMaxRobots`
  double rate_hz = 2.0;                     ///< cycles a second of each robot, above 0 to 100
  double seconds = 5.0;                     ///< in which cycles begin, above 0 to 600
  std::chrono::milliseconds timeout{2000};  ///< a cycle without an answer after this is lost
  std::chrono::milliseconds in_time{250};   ///< a robot has use for an answer until then
};

inline constexpr std::size_t kMaxRobots = 1000;
/// Cycles of one run: more would only fill the memory with bodies that wait.
inline constexpr double kMaxCycles = 200'000;

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const LoadConfig& config);

/// What a cycle sends: a fresh observation, then the scores of poses against it.
class LoadBodies {
 public:
  virtual ~LoadBodies() = default;
  virtual const std::string& observation(std::size_t robot, std::size_t cycle) const = 0;
  virtual std::string score(std::size_t robot,
                            std::size_t cycle,
                            const std::string& observation_id) const = 0;
};

struct LoadReply {
  std::uint64_t request_id = 0;
  Result<std::string> body;
};

/// A line of its own for each robot, on which nothing waits.
class LoadWire {
 public:
  virtual ~LoadWire() = default;
  /// @param budget  How long the robot has use for the answer; at least 1 ms.
  virtual void send(std::size_t robot,
                    std::uint64_t request_id,
                    std::string_view method,
                    std::string_view body,
                    std::chrono::milliseconds budget) = 0;
  /// The next reply of any robot; `nullopt` at `until`.
  virtual std::optional<LoadReply> receive(TimePoint until) = 0;
};

/// Lets robots load a server: SetObservation, then Score, at `rate_hz` each, their cycles spread
/// evenly over time. Each request tells the server what is left of `in_time`, as a robot does that
/// knows when it is too late. A cycle's time runs from the moment at which it was meant to begin,
/// so a server that stalls is charged for every cycle that it holds up and not for one.
///
/// Ends when all cycles have ended, `config.seconds` + `config.timeout` after the start at the
/// latest.
/// @errors those of `validate`.
Result<LoadReport> run_open_loop(const LoadConfig& config,
                                 const LoadBodies& bodies,
                                 LoadWire& wire,
                                 const Clock& clock);

}  // namespace semview::client
