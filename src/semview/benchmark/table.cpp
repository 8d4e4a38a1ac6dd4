// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace semview::benchmark {
namespace {

using Line = std::vector<std::string>;

std::string ratio_text(double ratio) {
  return fmt::format("{:.{}f}x", ratio, ratio < 10.0 ? 2 : ratio < 100.0 ? 1 : 0);
}

std::string least_and_median(double least, double median, const std::string& unit) {
  if (least == median) return shown(least, unit);
  return fmt::format("{} ({})", shown(least, unit), shown(median, unit));
}

bool meets(const Finding& found, const Goal& goal, double bound) {
  const double value = goal.of_ours ? found.ours : found.ratio;
  return goal.at_most ? value <= bound : value >= bound;
}

std::string goal_text(const Row& row) {
  const std::optional<bool> reached = row.reached();
  if (!reached) return row.goal.text;
  std::string text = row.goal.text + (*reached ? ": yes" : ": no");
  if (const std::optional<bool> then = row.reached_then()) text += *then ? ", yes" : ", no";
  return text;
}

const Line kHeads = {"row",
                     "claim",
                     "plan",
                     "size",
                     "threads",
                     "clock",
                     "ours",
                     "the alternative",
                     "ratio",
                     "goal",
                     "results"};

Line cells_of(const Row& row) {
  Line line = {row.id, row.claim, row.subject, row.size, std::to_string(row.threads)};
  if (!row.found) {
    line.insert(line.end(), {"-", "-", "-", "-", row.goal.text, row.note});
    return line;
  }
  const Finding& found = *row.found;
  line.push_back(found.clock.empty() ? "-" : found.clock);
  line.push_back(least_and_median(found.ours, found.ours_median, found.unit));
  line.push_back(
      found.other == 0.0 ? "-" : least_and_median(found.other, found.other_median, found.unit));
  line.push_back(
      found.other == 0.0 ? "-"
      : found.ratio == found.ratio_median
          ? ratio_text(found.ratio)
          : fmt::format("{} ({})", ratio_text(found.ratio), ratio_text(found.ratio_median)));
  line.push_back(goal_text(row));
  line.push_back(row.note.empty() ? found.agreement : found.agreement + "; " + row.note);
  return line;
}

}  // namespace

Finding finding_of(const Turns& turns, std::string agreement) {
  return {.unit = "s",
          .ours = turns.ours.least_s,
          .ours_median = turns.ours.median_s,
          .other = turns.other.least_s,
          .other_median = turns.other.median_s,
          .ratio = turns.ratio(),
          .ratio_median = turns.median_ratio(),
          .rounds = turns.rounds,
          .clock = std::string(name_of(turns.clock)),
          .agreement = std::move(agreement)};
}

std::optional<bool> Row::reached() const {
  if (!found || goal.text.empty()) return std::nullopt;
  return meets(*found, goal, goal.value);
}

std::optional<bool> Row::reached_then() const {
  if (!found || !goal.then) return std::nullopt;
  return meets(*found, goal, *goal.then);
}

std::string shown(double value, const std::string& unit) {
  if (unit != "s") return fmt::format("{:.{}f} {}", value, value < 100.0 ? 1 : 0, unit);
  struct Prefix {
    double factor;
    const char* text;
  };
  constexpr std::array kPrefixes = {Prefix{1.0, ""}, Prefix{1e3, "m"}, Prefix{1e6, "u"}};
  for (const Prefix& prefix : kPrefixes) {
    const double scaled = value * prefix.factor;
    if (scaled < 1.0 && prefix.factor < 1e6) continue;
    const int decimals = scaled < 10.0 ? 2 : scaled < 100.0 ? 1 : 0;
    return fmt::format("{:.{}f} {}{}", scaled, decimals, prefix.text, unit);
  }
  return {};
}

std::string to_text(std::span<const Row> rows) {
  std::vector<Line> lines = {kHeads};
  for (const Row& row : rows) lines.push_back(cells_of(row));
  std::vector<std::size_t> widths(kHeads.size(), 0);
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const Line& line : lines) {
    std::string printed;
    for (std::size_t i = 0; i < line.size(); ++i) {
      printed += fmt::format("{:<{}}", line[i], widths[i] + 2);
    }
    printed.erase(printed.find_last_not_of(' ') + 1);
    text += printed + "\n";
  }
  return text;
}

std::string to_markdown(std::span<const Row> rows) {
  const auto line_of = [](const Line& line) {
    std::string text = "|";
    for (const std::string& cell : line) text += " " + cell + " |";
    return text + "\n";
  };
  std::string text = line_of(kHeads) + line_of(Line(kHeads.size(), "---"));
  for (const Row& row : rows) text += line_of(cells_of(row));
  return text;
}

}  // namespace semview::benchmark
