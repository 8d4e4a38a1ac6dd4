// SPDX-License-Identifier: Apache-2.0
/// The engine that the tests are run with: SEMVIEW_ENGINE, as for the programs.
#pragma once

#include <cstdlib>
#include <string>

namespace semview::testing {

/// "auto" unless the environment says otherwise.
inline std::string engine_wish() {
  const char* const wish = std::getenv("SEMVIEW_ENGINE");
  return wish != nullptr && *wish != '\0' ? wish : "auto";
}

/// The name of the engine that then casts plans.
inline std::string plan_engine() { return engine_wish() == "embree" ? "embree" : "columns"; }

}  // namespace semview::testing
