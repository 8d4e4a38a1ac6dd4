// SPDX-License-Identifier: Apache-2.0
#include "export_folder.hpp"

#include <system_error>

#include <fmt/format.h>

#include "semview/io/output_path.hpp"

namespace semview::paper2017 {

namespace fs = std::filesystem;

ExportFolder::ExportFolder(const fs::path& directory)
    : directory_(directory), unfinished_(directory / "unfinished_export") {}

Result<ExportFolder> ExportFolder::begin(const fs::path& directory) {
  std::error_code error;
  for (const char* const part : {"input", "truth"}) {
    if (!fs::exists(directory / part, error)) continue;
    return fail(Error{ErrorCode::kAlreadyExists,
                      fmt::format("{}: holds an export already ({})", directory.string(), part),
                      "--export",
                      "choose another --export"});
  }
  SEMVIEW_TRY_STATUS(io::check_output_folder(directory));
  ExportFolder folder(directory);
  fs::remove_all(folder.unfinished_, error);
  fs::create_directories(folder.unfinished_, error);
  if (error) return io::cannot_write(folder.unfinished_, error.value());
  return folder;
}

Status ExportFolder::finish() const {
  std::error_code error;
  // `input` last: with it the export is there.
  for (const char* const part : {"truth", "input"}) {
    fs::rename(unfinished_ / part, directory_ / part, error);
    if (error) return io::cannot_write(directory_ / part, error.value());
  }
  fs::remove_all(unfinished_, error);
  return {};
}

}  // namespace semview::paper2017
