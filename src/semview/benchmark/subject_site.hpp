// SPDX-License-Identifier: Apache-2.0
/// A subject's map as files, and how the service opens it. Inside the module only.
#pragma once

#include <filesystem>
#include <memory>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/scratch_folder.hpp"
#include "semview/service/site.hpp"

namespace semview::benchmark::detail {

/// The subject's map as files: its own, or the office written down.
/// @errors those of `write_office`
Result<std::filesystem::path> bundle_of(const Subject& subject, const ScratchFolder& folder);

service::SiteConfig config_of(const Circumstances& in);

/// Opens a map for a row, which tells from then on what engine casts there.
/// @errors those of `service::Site::open`
Result<std::shared_ptr<service::Site>> open_site(const std::filesystem::path& map,
                                                 const service::SiteConfig& config,
                                                 Row& row);

}  // namespace semview::benchmark::detail
