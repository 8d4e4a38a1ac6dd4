// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace semview::cli {

/// For people: `12 s`, `3 min 05 s`, `2 h 40 min`.
std::string duration_text(double seconds);

}  // namespace semview::cli
