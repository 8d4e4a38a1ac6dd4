// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/subject_site.hpp"

#include <system_error>

#include "semview/benchmark/office_plan.hpp"

namespace semview::benchmark::detail {

Result<std::filesystem::path> bundle_of(const Subject& subject, const ScratchFolder& folder) {
  if (!subject.office) {
    std::error_code ignored;
    const bool bare = !std::filesystem::exists(subject.map->directory / "map.yaml", ignored);
    return bare ? subject.map->mesh()->file : subject.map->directory;
  }
  SEMVIEW_TRY_STATUS(write_office(*subject.office, folder / "map"));
  return folder / "map";
}

service::SiteConfig config_of(const Circumstances& in) {
  service::SiteConfig config;
  config.engine = in.engine;
  config.profile.camera = in.camera;
  config.profile.eye_height_m = kEyeHeight_m;
  config.threads = in.pool.threads();
  return config;
}

Result<std::shared_ptr<service::Site>> open_site(const std::filesystem::path& map,
                                                 const service::SiteConfig& config,
                                                 Row& row) {
  SEMVIEW_TRY(std::shared_ptr<service::Site> site, service::Site::open(map, config));
  row.engine = site->engine().name;
  row.engine_reason = site->engine().reason;
  return site;
}

}  // namespace semview::benchmark::detail
