// SPDX-License-Identifier: Apache-2.0
/// What methods did, for scripts.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "experiments/paper2017/results.hpp"

namespace semview::cli {

/// A line a row, start and method. Null where a method does not tell.
/// @param row_name  what rows are, for example "log"
nlohmann::ordered_json summaries_json(const paper2017::Results& results,
                                      const std::string& row_name);

}  // namespace semview::cli
