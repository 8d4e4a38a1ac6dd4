// SPDX-License-Identifier: Apache-2.0
/// The map that a row is localized on, ready to answer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "layout.hpp"
#include "rows.hpp"
#include "semview/core/result.hpp"
#include "semview/service/site.hpp"

namespace semview::paper2017 {

/// The views of the experiment: 3° columns and 2° rows over the camera's height.
ViewProfile experiment_profile();

/// @param engine  as of every verb: auto, columns or embree
service::SiteConfig site_config(const std::string& engine);

/// Where the plan of a world lies below `directory`.
std::filesystem::path plan_directory(const std::filesystem::path& directory,
                                     std::uint64_t world,
                                     ClassSubset classes,
                                     bool stacked);

/// Draws the plan of a layout there, undistorted.
/// @errors kUnavailable: cannot be written.
Status draw_world_plan(const Layout& layout,
                       std::uint64_t world,
                       ClassSubset classes,
                       bool stacked,
                       const std::filesystem::path& directory);

/// The drawn plan, distorted as the row says.
/// @errors those of loading, distorting and opening a map.
Result<std::shared_ptr<service::Site>> open_row_map(const Row& row,
                                                    std::uint64_t world,
                                                    bool stacked,
                                                    const std::filesystem::path& directory,
                                                    const std::string& engine);

}  // namespace semview::paper2017
