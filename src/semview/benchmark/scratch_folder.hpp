// SPDX-License-Identifier: Apache-2.0
/// A place for files that are gone when they have been measured. Inside the module only.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "semview/core/result.hpp"

namespace semview::benchmark::detail {

/// A folder of this process that goes with this object; one at a time.
class ScratchFolder {
 public:
  /// @errors kUnavailable: there is no folder for temporary files, or it cannot be written to.
  static Result<ScratchFolder> make();
  ~ScratchFolder();
  ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace semview::benchmark::detail
