// SPDX-License-Identifier: Apache-2.0
#include "semview/io/output_path.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace semview::io {
namespace {

using Path = std::filesystem::path;

tl::unexpected<Error> refuse(const Path& path, std::string_view why, std::string remedy) {
  return fail(Error{ErrorCode::kUnavailable,
                    fmt::format("{}: cannot be written: {}", path.string(), why),
                    {},
                    std::move(remedy)});
}

/// "out" for "out/est.tum", "." for "est.tum".
Path folder_of(const Path& path) {
  const Path folder = path.parent_path();
  return folder.empty() ? Path(".") : folder;
}

Status check_folder(const Path& path, const Path& folder) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    return refuse(
        path, fmt::format("{} is not a folder", folder.string()), "name a file in a folder");
  }
  // Making a file in a folder takes both rights; as root only a read-only disk lacks one.
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return cannot_write(path, errno);
  return {};
}

}  // namespace

tl::unexpected<Error> cannot_write(const Path& path, int error_number) {
  std::string remedy;
  if (error_number == ENOSPC || error_number == EDQUOT) {
    remedy = "free some space there, or name a file on another disk";
  } else if (error_number == EACCES || error_number == EPERM || error_number == EROFS) {
    remedy = "name a file in a folder that you may write to";
  }
  return refuse(path, std::generic_category().message(error_number), std::move(remedy));
}

Status check_output_file(const Path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored) || path.filename().empty()) {
    return refuse(path, "it is a folder", "name a file in it");
  }
  const Path folder = folder_of(path);
  if (!std::filesystem::exists(folder, ignored)) {
    return refuse(path,
                  fmt::format("the folder {} is not there", folder.string()),
                  fmt::format("make it first: mkdir -p {}", folder.string()));
  }
  if (std::filesystem::exists(path, ignored) && ::access(path.c_str(), W_OK) != 0) {
    return cannot_write(path, errno);
  }
  return check_folder(path, folder);
}

Status check_output_png(const Path& path) {
  SEMVIEW_TRY_STATUS(check_output_file(path));
  std::string ending = path.extension().string();
  std::ranges::transform(
      ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending.empty() || ending == ".png") return {};
  return fail(
      Error{ErrorCode::kInvalidArgument,
            fmt::format("{}: is not the name of a PNG, which is what is written", path.string()),
            {},
            "end the name in .png"});
}

Status check_output_folder(const Path& path) {
  std::error_code error;
  Path missing;
  Path nearest = path;
  while (!std::filesystem::exists(nearest, error)) {
    const Path above = folder_of(nearest);
    if (above == nearest) break;
    missing = nearest;
    nearest = above;
  }
  SEMVIEW_TRY_STATUS(check_folder(path, nearest));
  if (missing.empty()) return {};
  // Some places, as /proc, give all rights and take no folders: only trying tells.
  if (!std::filesystem::create_directory(missing, error) && error) {
    return cannot_write(path, error.value());
  }
  std::filesystem::remove(missing, error);
  return {};
}

}  // namespace semview::io
