// SPDX-License-Identifier: Apache-2.0
/// A subject's map as files, and how the service opens it. Inside the module only.
#pragma once

#include <filesystem>
#include <string>

#include "semview/benchmark/measurement.hpp"
#include "semview/service/site.hpp"

namespace semview::benchmark::detail {

/// A folder that goes with this object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The subject's map as files: its own, or the office written down.
/// @errors those of `write_office`
Result<std::filesystem::path> bundle_of(const Subject& subject, const ScratchFolder& folder);

service::SiteConfig config_of(const Circumstances& in);

}  // namespace semview::benchmark::detail
