// SPDX-License-Identifier: Apache-2.0
#include "semview/io/output_path.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

namespace semview::io {
namespace {

using Path = std::filesystem::path;

struct FolderFormat {
  FolderKind kind;
  std::string_view what;
  std::string_view marker;  ///< the file that makes a folder one
  std::vector<std::string_view> files;
  std::string_view drawn;  ///< a file that is made of the others: it may be made again
};

const std::array<FolderFormat, 3>& folder_formats() {
  static const std::array<FolderFormat, 3> kFormats{
      {{FolderKind::kMap, "map", "map.yaml", {"labels.png", "objects.geojson"}, "occupancy.png"},
       {FolderKind::kRunLog,
        "run log",
        "log.yaml",
        {"frames.csv", "odometry.txt", "groundtruth.txt"},
        {}},
       {FolderKind::kObservation,
        "observation",
        "observation.yaml",
        {"labels.png", "confidence.png"},
        {}}}};
  return kFormats;
}

bool is_there(const Path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

tl::unexpected<Error> would_be_lost(const Path& path,
                                    const std::string& why,
                                    std::string_view remedy) {
  return fail(Error{ErrorCode::kAlreadyExists,
                    fmt::format("{}: {}", path.string(), why),
                    {},
                    std::string(remedy)});
}

/// Refuses a file that a folder of ours consists of.
Status check_is_no_part(const Path& path, const Path& folder) {
  if (!is_there(path)) return {};
  const std::string name = path.filename().string();
  for (const FolderFormat& format : folder_formats()) {
    const bool part =
        name == format.marker || std::ranges::find(format.files, name) != format.files.end();
    if (!part || !is_there(folder / format.marker)) continue;
    return would_be_lost(
        path,
        fmt::format("is part of the {} in this folder, and would be written over", format.what),
        "name another file");
  }
  return {};
}

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
  SEMVIEW_TRY_STATUS(check_is_no_part(path, folder));
  return check_folder(path, folder);
}

Status check_is_no_input(const Path& path, std::span<const std::string> inputs) {
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(path, input, ignored)) continue;
    return would_be_lost(path, "is read as input, and would be written over", "name another file");
  }
  return {};
}

Status check_holds_nothing_else(const Path& path, FolderKind kind) {
  const auto& formats = folder_formats();
  const auto& own = *std::ranges::find(formats, kind, &FolderFormat::kind);
  constexpr std::string_view kRemedy = "name a new or empty folder";
  for (const FolderFormat& other : formats) {
    if (other.kind == kind || !is_there(path / other.marker)) continue;
    return would_be_lost(
        path,
        fmt::format("has {}, expected a new or empty folder for the {}", other.marker, own.what),
        {});
  }
  if (is_there(path / own.marker)) return {};
  std::vector<std::string_view> files = own.files;
  if (!own.drawn.empty()) files.push_back(own.drawn);
  for (const std::string_view file : files) {
    if (!is_there(path / file)) continue;
    return would_be_lost(path / file, "is there already, and would be written over", kRemedy);
  }
  return {};
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
