// SPDX-License-Identifier: Apache-2.0
/// What a finished experiment leaves for people: a page and pictures.
#pragma once

#include <filesystem>
#include <string>

#include "experiment.hpp"
#include "experiments/paper2017/report.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2023 {

/// Tables 1 and 2 beside the printed ones, their ratio, and all settings, in Markdown.
std::string report(const Experiment& experiment, const paper2017::ReportHeader& header);

/// Writes `report.md`, `runs.csv` and `error_{static,changed}.svg` into a folder, which is made.
/// @return the report's text. @errors kUnavailable: cannot be written.
Result<std::string> write_report(const Experiment& experiment,
                                 const paper2017::ReportHeader& header,
                                 const std::filesystem::path& directory);

}  // namespace semview::paper2023
