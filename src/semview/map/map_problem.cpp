// SPDX-License-Identifier: Apache-2.0
#include "semview/map/map_problem.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::map {

std::string place_of(const MapProblem& problem) {
  std::string place = problem.file.string();
  if (problem.line > 0) place += fmt::format(":{}", problem.line);
  if (problem.pixel) {
    place += fmt::format(": pixel (x {}, y {})", problem.pixel->column, problem.pixel->row);
  }
  if (problem.feature) {
    place += fmt::format(": feature {}", problem.feature->number);
    if (!problem.feature->name.empty()) place += fmt::format(" ({})", problem.feature->name);
  }
  return place;
}

std::string to_string(const MapProblem& problem) {
  const char* severity = problem.severity == Severity::kError ? "error" : "warning";
  std::string text = fmt::format("{}: {}: {}", place_of(problem), severity, problem.message);
  if (!problem.remedy.empty()) text += "; " + problem.remedy;
  return text;
}

MapProblem file_problem(Severity severity,
                        const std::filesystem::path& file,
                        std::string message,
                        std::string remedy) {
  return line_problem(severity, file, 0, std::move(message), std::move(remedy));
}

MapProblem line_problem(Severity severity,
                        const std::filesystem::path& file,
                        int line,
                        std::string message,
                        std::string remedy) {
  MapProblem problem;
  problem.severity = severity;
  problem.file = file;
  problem.line = line;
  problem.message = std::move(message);
  problem.remedy = std::move(remedy);
  return problem;
}

MapProblem problem_of(const std::filesystem::path& file, const Error& error) {
  std::string_view message = error.message;
  int line = 0;
  const std::string name = file.string();
  if (message.starts_with(name + ":")) {
    message.remove_prefix(name.size() + 1);
    const char* const end = message.data() + message.size();
    const auto [stop, status] = std::from_chars(message.data(), end, line);
    if (status == std::errc() && stop != end && *stop == ':') {
      message.remove_prefix(static_cast<std::size_t>(stop - message.data()) + 1);
    } else {
      line = 0;
    }
    if (message.starts_with(' ')) message.remove_prefix(1);
  }
  MapProblem problem = line_problem(Severity::kError, file, line, std::string(message), error.hint);
  problem.code = error.code;
  return problem;
}

std::size_t MapReport::count(Severity severity) const {
  return static_cast<std::size_t>(
      std::count_if(problems.begin(), problems.end(), [severity](const MapProblem& problem) {
        return problem.severity == severity;
      }));
}

void sort_by_place(MapReport& report) {
  const auto place = [](const MapProblem& problem) {
    constexpr int kLast = std::numeric_limits<int>::max();
    const bool whole = problem.line == 0 && !problem.pixel && !problem.feature;
    const PixelIndex pixel = problem.pixel.value_or(PixelIndex{});
    const int feature = problem.feature ? problem.feature->number : 0;
    return std::tuple(problem.file, whole ? kLast : problem.line, feature, pixel.row, pixel.column);
  };
  std::stable_sort(report.problems.begin(),
                   report.problems.end(),
                   [&](const MapProblem& a, const MapProblem& b) { return place(a) < place(b); });
}

Error first_error(const MapReport& report) {
  const auto found =
      std::find_if(report.problems.begin(), report.problems.end(), [](const MapProblem& problem) {
        return problem.severity == Severity::kError;
      });
  SEMVIEW_CHECK(found != report.problems.end());
  Error error{found->code, place_of(*found) + ": " + found->message};
  error.hint = found->remedy;
  return error;
}

}  // namespace semview::map
