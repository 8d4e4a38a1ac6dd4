// SPDX-License-Identifier: Apache-2.0
/// The likelihoods that codec 2 would have if it were made for some maps.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "semview/view/column_view.hpp"

namespace semview::bench {

/// How often each situation was answered no and yes, every map of one weight.
using AnswerCounts = std::vector<std::pair<double, double>>;

/// Adds the answers of one map's views, which come in blocks of 64, to one entry a situation.
void count_answers(std::span<const std::vector<ColumnView>> blocks, AnswerCounts& counts);

/// As the table of src/semview/view/view_situations.cpp.
void print_likelihoods(const AnswerCounts& counts);

}  // namespace semview::bench
