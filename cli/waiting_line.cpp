// SPDX-License-Identifier: Apache-2.0
#include "waiting_line.hpp"

#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "duration_text.hpp"

namespace semview::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSilence{2000};
constexpr milliseconds kOnTerminal{100};
constexpr milliseconds kElsewhere{5000};

}  // namespace

WaitingLine::WaitingLine(std::string hint, bool on_terminal, const Clock& clock)
    : hint_(std::move(hint)),
      on_terminal_(on_terminal),
      clock_(clock),
      first_(clock.now()),
      began_(first_),
      next_(first_ + kSilence) {}

std::string WaitingLine::text(std::size_t done, std::size_t all, std::string_view unit) {
  const TimePoint now = clock_.now();
  if (unit != unit_) {
    unit_ = unit;
    began_ = now;
  }
  const bool last = done >= all;
  // A line that stands on the terminal is brought to its end.
  if (now < next_ && !(last && line_open_)) return "";
  next_ = now + (on_terminal_ ? kOnTerminal : kElsewhere);
  std::string text = hint_.empty() ? "" : hint_ + "\n";
  hint_.clear();
  text += fmt::format("{}{} of {} {}", on_terminal_ ? "\r\x1b[K" : "", done, all, unit_);
  if (done > 0 && !last) {
    const double taken_s = std::chrono::duration<double>(now - began_).count();
    const double a_step_s = taken_s / static_cast<double>(done);
    text +=
        fmt::format(", about {} left", duration_text(a_step_s * static_cast<double>(all - done)));
  }
  line_open_ = on_terminal_ && !last;
  if (!line_open_) text += "\n";
  return text;
}

void WaitingLine::show(std::size_t done, std::size_t all, std::string_view unit) {
  fmt::print(stderr, "{}", text(done, all, unit));
  std::fflush(stderr);
}

WaitingLine waiting_for_views(const std::string& cache_directory) {
  return {cache_directory.empty()
              ? "the map's views are drawn first; --cache DIR keeps them for the next time"
              : "",
          ::isatty(STDERR_FILENO) == 1};
}

}  // namespace semview::cli
