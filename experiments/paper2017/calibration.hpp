// SPDX-License-Identifier: Apache-2.0
/// The page that tells how hard the simulated experiment is beside the paper's.
#pragma once

#include <string>

#include "report.hpp"
#include "results.hpp"

namespace semview::paper2017 {

/// Markdown: the network's confusions, accuracy and borders, what differs between world and map,
/// odometry and the baseline's rows beside the printed ones.
std::string calibration_page(const Results& results, const ReportHeader& header);

}  // namespace semview::paper2017
