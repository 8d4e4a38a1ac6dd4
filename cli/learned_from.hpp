// SPDX-License-Identifier: Apache-2.0
/// Which run logs a learned matrix has seen: on those it proves nothing.
#pragma once

#include <string>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::cli {

/// Comment lines for the head of a learned matrix, one a log, that `check_not_learned_from` knows
/// again: docs/formats/weights.md.
Result<std::string> learned_from_lines(const std::vector<std::string>& logs);

/// @errors kFailedPrecondition: the matrix in this file was learned from one of these logs, under
///         whatever name; those of reading. A file without such lines passes.
Status check_not_learned_from(const std::string& weights_file,
                              const std::vector<std::string>& logs);

}  // namespace semview::cli
