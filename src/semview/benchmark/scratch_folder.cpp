// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/scratch_folder.hpp"

#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace semview::benchmark::detail {
namespace {

tl::unexpected<Error> no_folder(std::string what, const std::error_code& reason) {
  return fail(Error{ErrorCode::kUnavailable,
                    fmt::format("{}: {}", what, reason.message()),
                    {},
                    "set TMPDIR to a folder that can be written to"});
}

}  // namespace

Result<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) return no_folder("no folder for temporary files", error);
  const std::filesystem::path path = parent / fmt::format("semview_bench_{}", getpid());
  std::filesystem::create_directories(path, error);
  if (error) return no_folder(path.string(), error);
  return ScratchFolder(path);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace semview::benchmark::detail
