// SPDX-License-Identifier: Apache-2.0
/// The log of the programs: one line a message on standard error.
#pragma once

#include <string_view>

namespace semview {

/// @threads safe
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace semview
