// SPDX-License-Identifier: Apache-2.0
/// What others print of putting single pictures on a floor plan.
#pragma once

#include <string>

namespace semview::cli {

/// A paragraph: each method with its input and data, and its figures where their source was read.
/// Other pictures in other buildings: no ranking, a scale.
std::string printed_by_others();

}  // namespace semview::cli
