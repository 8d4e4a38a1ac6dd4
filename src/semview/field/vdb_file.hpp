// SPDX-License-Identifier: Apache-2.0
/// Semantic volumes as OpenVDB files, that other tools open too. See docs/formats/volume.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "semview/core/result.hpp"
#include "semview/field/semantic_volume.hpp"

namespace semview::field {

/// A volume and how far its fusion has come.
struct StoredVolume {
  SemanticVolume volume;
  std::uint64_t frames = 0;  ///< of the source that were looked at, skipped ones included
  std::uint64_t skipped = 0;
  std::string source;  ///< what it was made of and how; a fusion goes on only where it agrees
};

/// Writes beside the file and renames: what is there is whole at any time.
/// @errors kUnavailable: cannot be written.
Status write_vdb(const std::filesystem::path& path, const StoredVolume& stored);

/// @errors kNotFound: no such file; kInvalidArgument: no OpenVDB file, or one of another kind;
/// kDataLoss: grids that do not fit together; kUnimplemented: a newer format; kResourceExhausted:
/// more than `kMaxBlocks`.
Result<StoredVolume> read_vdb(const std::filesystem::path& path);

/// What a file says of itself; its voxels are not read.
struct VolumeSummary {
  VolumeShape shape;
  ClassTable classes;
  std::uint64_t frames = 0;
  std::uint64_t skipped = 0;
  std::string source;
};

/// @errors those of `read_vdb` that are seen without reading voxels.
Result<VolumeSummary> read_vdb_summary(const std::filesystem::path& path);

}  // namespace semview::field
