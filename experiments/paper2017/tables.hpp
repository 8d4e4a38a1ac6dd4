// SPDX-License-Identifier: Apache-2.0
/// The experiment's tables, in Markdown.
#pragma once

#include <string>

#include "results.hpp"

namespace semview::paper2017 {

/// Fig. 3, right: the mean error of each method's estimate, and of its nearest particle ("min"),
/// beside what is printed. Columns are named after their quantity: the paper's methods answer with
/// their best particle, ours and those of others with an estimate of their own.
std::string fig3_table(const Results& results, Start start);

/// Of each row and method, by the errors of `fig3_table`: mean, median over worlds, 95 % interval
/// over worlds, stops above 0.3 m and 1 m, the paired difference to weighted and its interval, the
/// ratio, and ours against goals.
std::string spread_table(const Results& results, Start start);

/// From which image on the error stays below half a metre.
std::string localized_table(const Results& results);

/// The mean error at each image, over worlds and runs; empty if nothing was run with that start.
std::string image_table(const Results& results, Start start);

/// What ours has found of the map's distortion after the last stop.
std::string distortion_table(const Results& results, Start start);

/// Ours, and ours without one idea each; empty if no such methods were run.
std::string ablation_table(const Results& results, Start start);

}  // namespace semview::paper2017
