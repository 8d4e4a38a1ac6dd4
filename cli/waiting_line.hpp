// SPDX-License-Identifier: Apache-2.0
/// How far long work is, for people who wait for it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "semview/core/clock.hpp"

namespace semview::cli {

/// What to print of work that is done in steps: nothing while it may soon be over, then a line that
/// is written over on a terminal, elsewhere one every few seconds.
class WaitingLine {
 public:
  /// @param hint  a line of its own before the first, for example how to wait less; may be empty
  WaitingLine(std::string hint, bool on_terminal, const Clock& clock = steady_clock());

  /// To be printed as it is; often empty. Another `unit` begins other work.
  std::string text(std::size_t done, std::size_t all, std::string_view unit);

  /// The same, printed on standard error.
  void show(std::size_t done, std::size_t all, std::string_view unit);

 private:
  std::string hint_;
  bool on_terminal_;
  const Clock& clock_;
  TimePoint first_;  ///< of all work
  std::string unit_;
  TimePoint began_;  ///< with this unit
  TimePoint next_;
  bool line_open_ = false;  ///< on the terminal
};

/// Of a verb that draws a map's views: says how to keep them, unless `cache_directory` is given.
WaitingLine waiting_for_views(const std::string& cache_directory);

}  // namespace semview::cli
