// SPDX-License-Identifier: Apache-2.0
#include "row_map.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/map/distortion.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::uint64_t kMemory_bytes = std::uint64_t{256} << 20U;  ///< of each thread's views

}  // namespace

ViewProfile experiment_profile() {
  ViewProfile profile;
  profile.camera = {120, 38, -rad_from_deg(38.0), rad_from_deg(38.0)};
  return profile;
}

service::SiteConfig site_config(const std::string& engine) {
  service::SiteConfig config;
  config.profile = experiment_profile();
  config.engine = engine;
  config.memory_bytes = kMemory_bytes;
  config.threads = 1;
  return config;
}

std::filesystem::path plan_directory(const std::filesystem::path& directory,
                                     std::uint64_t world,
                                     ClassSubset classes,
                                     bool stacked) {
  return directory / fmt::format("world_{}_{}{}", world, name(classes), stacked ? "_stacked" : "");
}

Status draw_world_plan(const Layout& layout,
                       std::uint64_t world,
                       ClassSubset classes,
                       bool stacked,
                       const std::filesystem::path& directory) {
  return draw_plan(layout,
                   {.stacked = stacked, .classes = classes},
                   world,
                   plan_directory(directory, world, classes, stacked));
}

Result<std::shared_ptr<service::Site>> open_row_map(const Row& row,
                                                    std::uint64_t world,
                                                    bool stacked,
                                                    const std::filesystem::path& directory,
                                                    const std::string& engine) {
  SEMVIEW_TRY(const map::SemanticMap drawn,
              map::load_map(plan_directory(directory, world, row.classes, stacked)));
  SEMVIEW_TRY(map::SemanticMap distorted, map::distort(drawn, row.affine));
  const service::SiteConfig config = site_config(engine);
  SEMVIEW_TRY(service::SharedTiers tiers, service::SharedTiers::open(config));
  return service::Site::of(std::move(distorted), config, std::move(tiers));
}

}  // namespace semview::paper2017
