// SPDX-License-Identifier: Apache-2.0
#include "semview/core/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace semview::detail {

void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: internal check failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace semview::detail
