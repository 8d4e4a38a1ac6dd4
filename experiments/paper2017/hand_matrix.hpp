// SPDX-License-Identifier: Apache-2.0
/// weights/paper2017_ade20k150.csv as built in: the paper's concepts for its 150 classes.
#pragma once

#include <string_view>

namespace semview::paper2017 {

extern const std::string_view kHandMatrix;

}  // namespace semview::paper2017
