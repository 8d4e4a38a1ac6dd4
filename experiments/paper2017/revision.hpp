// SPDX-License-Identifier: Apache-2.0
/// Which state of the repository the program was built from.
#pragma once

#include <string_view>

namespace semview::paper2017 {

/// The commit's short name, with "+" if files differed from it; "unknown" without git.
extern const std::string_view kRevision;

}  // namespace semview::paper2017
