// SPDX-License-Identifier: Apache-2.0
#include "eye_heights.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "semview/map/semantic_map.hpp"

namespace semview::cli {

void add_eye_height_options(CLI::App& verb, EyeHeightOptions& options) {
  add_site_options(verb, options.site);
  verb.remove_option(verb.get_option("--eye-height"));
  verb.add_option(
          "--eye-height",
          options.eye_heights_m,
          "Eye above the ground, metres; may be repeated. With several, or without (1.2 and "
          "1.5), the height is searched, too")
      ->type_name("METRES");
}

Result<std::vector<std::shared_ptr<service::Site>>> open_floors(const EyeHeightOptions& options,
                                                                const map::SemanticMap& map) {
  std::vector<double> heights_m = options.eye_heights_m;
  if (heights_m.empty()) {
    heights_m.assign(std::begin(kUsualEyeHeights_m), std::end(kUsualEyeHeights_m));
  }
  for (const double height_m : heights_m) {
    // Twice the same would have the height searched between it and itself.
    if (std::ranges::count(heights_m, height_m) <= 1) continue;
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("--eye-height {:g}: is named twice; expected each once", height_m),
              "--eye-height"});
  }
  SEMVIEW_TRY(service::SiteConfig config, site_config(options.site));
  SEMVIEW_TRY(const service::SharedTiers tiers, service::SharedTiers::open(config));
  std::vector<std::shared_ptr<service::Site>> floors;
  for (const double height_m : heights_m) {
    config.profile.eye_height_m = height_m;
    SEMVIEW_TRY(std::shared_ptr<service::Site> floor, service::Site::of(map, config, tiers));
    floors.push_back(std::move(floor));
  }
  return floors;
}

Result<std::vector<std::shared_ptr<service::Site>>> open_floors(const EyeHeightOptions& options) {
  SEMVIEW_TRY(const map::SemanticMap map,
              map::load_map(options.site.map, {options.site.nearest_colour}));
  return open_floors(options, map);
}

}  // namespace semview::cli
