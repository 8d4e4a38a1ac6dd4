// SPDX-License-Identifier: Apache-2.0
/// Small bundles, each of which breaks one rule of `semview map check` and nothing else.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map/bundle.hpp"
#include "semview/map/map_checker.hpp"

namespace semview::map {

class MapCheckerTest : public ::testing::Test {
 protected:
  MapCheck check(const std::string& yaml,
                 const std::vector<std::string>& rows = testing::room(),
                 const CheckOptions& options = {}) {
    testing::write_bundle(folder_.path(), rows, yaml);
    return check_map(folder_.path(), options);
  }

  static std::string text_of(const MapCheck& check) {
    std::string all;
    for (const MapProblem& problem : check.report.problems) all += to_string(problem) + "\n";
    return all;
  }

  /// Expects exactly one problem and returns it.
  MapProblem only(const MapCheck& check, Severity severity) {
    const std::string all = text_of(check);
    EXPECT_EQ(check.report.problems.size(), 1U) << all;
    if (check.report.problems.empty()) return {};
    const MapProblem& problem = check.report.problems.front();
    EXPECT_EQ(problem.severity, severity) << all;
    EXPECT_EQ(check.map.has_value(), severity == Severity::kWarning || check_loads_);
    return problem;
  }

  /// One error in a line of map.yaml, with all of `words` in what is printed.
  void expect_error(const std::string& yaml, int line, const std::vector<std::string>& words) {
    const MapProblem problem = only(check(yaml), Severity::kError);
    expect_words(problem, line, words);
  }
  void expect_warning(const std::string& yaml, int line, const std::vector<std::string>& words) {
    const MapProblem problem = only(check(yaml), Severity::kWarning);
    expect_words(problem, line, words);
  }
  void expect_words(const MapProblem& problem, int line, const std::vector<std::string>& words) {
    EXPECT_EQ(problem.file.filename(), "map.yaml");
    EXPECT_EQ(problem.line, line);
    const std::string text = to_string(problem);
    EXPECT_THAT(text, ::testing::HasSubstr(fmt::format("map.yaml:{}: ", line)));
    for (const std::string& word : words) EXPECT_THAT(text, ::testing::HasSubstr(word));
  }

  testing::TempFolder folder_;
  bool check_loads_ = false;
};

}  // namespace semview::map
