// SPDX-License-Identifier: Apache-2.0
/// What a finished experiment leaves for people: pages and pictures.
#pragma once

#include <filesystem>
#include <string>

#include "report.hpp"
#include "results.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// Writes `report.md`, `calibration.md` and the figures; returns the report's text.
/// @errors kUnavailable: cannot be written; those of drawing plans.
Result<std::string> write_report(const Results& results,
                                 const ReportHeader& header,
                                 const std::filesystem::path& directory);

}  // namespace semview::paper2017
