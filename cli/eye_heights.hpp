// SPDX-License-Identifier: Apache-2.0
/// One map at one or several eye heights: for pictures of which nobody wrote down how high the
/// camera stood.
#pragma once

#include <memory>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/service/site.hpp"
#include "site_options.hpp"

namespace CLI {
class App;
}

namespace semview::cli {

struct EyeHeightOptions {
  SiteOptions site;                   ///< its eye height is not looked at
  std::vector<double> eye_heights_m;  ///< empty: `kUsualEyeHeights_m`
};

/// What tripods, robots and people hold a camera at; between and 0.2 m beyond them a search finds
/// the height by itself.
inline constexpr double kUsualEyeHeights_m[] = {1.2, 1.5};

/// As `add_site_options`, but for --eye-height, which may be given several times.
void add_eye_height_options(CLI::App& verb, EyeHeightOptions& options);

/// One site a height, with one cache and one pool.
Result<std::vector<std::shared_ptr<service::Site>>> open_floors(const EyeHeightOptions& options);

/// The same of a map that is loaded already.
Result<std::vector<std::shared_ptr<service::Site>>> open_floors(const EyeHeightOptions& options,
                                                                const map::SemanticMap& map);

}  // namespace semview::cli
