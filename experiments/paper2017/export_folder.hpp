// SPDX-License-Identifier: Apache-2.0
/// A folder that an export fills with `input` and `truth`, or leaves without either.
#pragma once

#include <filesystem>

#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// Where an export is written until it is whole: what was stopped never looks finished, and is
/// made again.
class ExportFolder {
 public:
  /// Begins an export to `directory`, without what a stopped one left in the folder for it.
  /// @errors kAlreadyExists: there is an export, or something of its names; those of
  ///         `io::check_output_folder`.
  static Result<ExportFolder> begin(const std::filesystem::path& directory);

  /// Holds `input` and `truth` so far.
  const std::filesystem::path& unfinished() const { return unfinished_; }

  /// Moves both to where they belong.
  Status finish() const;

 private:
  explicit ExportFolder(const std::filesystem::path& directory);

  std::filesystem::path directory_;
  std::filesystem::path unfinished_;
};

}  // namespace semview::paper2017
