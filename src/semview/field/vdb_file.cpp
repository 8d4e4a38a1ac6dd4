// SPDX-License-Identifier: Apache-2.0
#include "semview/field/vdb_file.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

namespace semview::field {
namespace {

constexpr int kFormat = 1;
constexpr const char* kDistance = "tsdf";
constexpr const char* kWeight = "weight";
constexpr const char* kClass = "class";
constexpr const char* kColour = "colour";
constexpr const char* kColourWeight = "colour_weight";
constexpr const char* kCount = "count_";  // and the class's name

constexpr const char* kFormatKey = "semview_format";
constexpr const char* kClassesKey = "semview_classes";
constexpr const char* kVoxelKey = "semview_voxel_m";
constexpr const char* kTruncationKey = "semview_truncation_m";
constexpr const char* kFramesKey = "semview_frames";
constexpr const char* kSkippedKey = "semview_skipped";
constexpr const char* kSourceKey = "semview_source";

using Block = VoxelBlock;

openvdb::Coord coord_of(const VoxelIndex& voxel) { return {voxel.x, voxel.y, voxel.z}; }
VoxelIndex voxel_of(const openvdb::Coord& coord) { return {coord.x(), coord.y(), coord.z()}; }

/// OpenVDB puts z first in a leaf; a block has x first.
std::size_t place_of(openvdb::Index offset) {
  return static_cast<std::size_t>((offset >> 6U & 7U) | (offset & 070U) | (offset & 7U) << 6U);
}

template <typename Grid>
typename Grid::Ptr make_grid(const char* name,
                             const typename Grid::ValueType& background,
                             double voxel_m) {
  typename Grid::Ptr grid = Grid::create(background);
  grid->setName(name);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_m);
  // A voxel's value stands at its centre.
  transform->postTranslate(openvdb::Vec3d(voxel_m / 2.0));
  grid->setTransform(transform);
  return grid;
}

/// Active voxels where `value_at(block, place)` gives one.
template <typename Grid, typename ValueAt>
typename Grid::Ptr fill(const SemanticVolume& volume,
                        const char* name,
                        const typename Grid::ValueType& background,
                        const ValueAt& value_at) {
  typename Grid::Ptr grid = make_grid<Grid>(name, background, volume.shape().voxel_m);
  for (const SemanticVolume::BlockIndex& index : volume.block_indices()) {
    const Block& block = *volume.block(index);
    typename Grid::TreeType::LeafNodeType* leaf = nullptr;
    for (openvdb::Index offset = 0; offset < Block::kVoxels; ++offset) {
      const auto value = value_at(block, place_of(offset));
      if (!value) continue;
      if (leaf == nullptr) {
        leaf = grid->tree().touchLeaf(coord_of(SemanticVolume::voxel_of(index, 0)));
      }
      leaf->setValueOn(offset, *value);
    }
  }
  return grid;
}

template <typename T>
std::optional<T> where(bool there, const T& value) {
  return there ? std::optional<T>(value) : std::nullopt;
}

openvdb::GridPtrVec grids_of(const SemanticVolume& volume) {
  openvdb::GridPtrVec grids;
  grids.push_back(fill<openvdb::FloatGrid>(volume,
                                           kDistance,
                                           static_cast<float>(volume.shape().truncation_m),
                                           [](const Block& block, std::size_t p) {
                                             return where(block.weight[p] > 0.0F, block.sdf_m[p]);
                                           }));
  grids.push_back(
      fill<openvdb::FloatGrid>(volume, kWeight, 0.0F, [](const Block& block, std::size_t p) {
        return where(block.weight[p] > 0.0F, block.weight[p]);
      }));
  grids.push_back(
      fill<openvdb::Int32Grid>(volume, kClass, 0, [](const Block& block, std::size_t p) {
        const ClassId label = block.most_likely_class(p);
        return where(label != kNoHit, static_cast<std::int32_t>(label));
      }));
  for (int c = 1; c <= volume.classes().size(); ++c) {
    const auto label = static_cast<ClassId>(c);
    const std::string name = kCount + std::string(volume.classes().name(label));
    grids.push_back(fill<openvdb::Int32Grid>(
        volume, name.c_str(), 0, [label](const Block& block, std::size_t p) {
          const auto layer = std::ranges::find(block.counts, label, &ClassCounts::label);
          const std::int32_t count = layer == block.counts.end() ? 0 : layer->count[p];
          return where(count > 0, count);
        }));
  }
  const auto coloured = [](const Block& block, std::size_t p) {
    return !block.colour.empty() && block.colour_weight[p] > 0.0F;
  };
  grids.push_back(fill<openvdb::Vec3SGrid>(
      volume, kColour, openvdb::Vec3s(0.0F), [&](const Block& block, std::size_t p) {
        return coloured(block, p)
                   ? std::optional(openvdb::Vec3s(
                         block.colour[p].x(), block.colour[p].y(), block.colour[p].z()))
                   : std::nullopt;
      }));
  grids.push_back(
      fill<openvdb::FloatGrid>(volume, kColourWeight, 0.0F, [&](const Block& block, std::size_t p) {
        return coloured(block, p) ? std::optional(block.colour_weight[p]) : std::nullopt;
      }));
  return grids;
}

openvdb::MetaMap metadata_of(const StoredVolume& stored) {
  std::string names;
  for (const std::string& name : stored.volume.classes().names()) names += name + '\n';
  openvdb::MetaMap meta;
  meta.insertMeta(kFormatKey, openvdb::Int32Metadata(kFormat));
  meta.insertMeta(kClassesKey, openvdb::StringMetadata(names));
  meta.insertMeta(kVoxelKey, openvdb::DoubleMetadata(stored.volume.shape().voxel_m));
  meta.insertMeta(kTruncationKey, openvdb::DoubleMetadata(stored.volume.shape().truncation_m));
  meta.insertMeta(kFramesKey, openvdb::Int64Metadata(static_cast<std::int64_t>(stored.frames)));
  meta.insertMeta(kSkippedKey, openvdb::Int64Metadata(static_cast<std::int64_t>(stored.skipped)));
  meta.insertMeta(kSourceKey, openvdb::StringMetadata(stored.source));
  return meta;
}

/// What is wrong with a file, without its name.
struct Refusal {
  ErrorCode code;
  std::string what;
};

template <typename T>
T value_of(const openvdb::MetaMap& meta, const char* key) {
  const auto found = meta.getMetadata<openvdb::TypedMetadata<T>>(key);
  if (!found) throw Refusal{ErrorCode::kDataLoss, fmt::format("{} is missing in it", key)};
  return found->value();
}

template <typename Grid>
typename Grid::Ptr find_grid(const openvdb::GridPtrVec& grids,
                             const std::string& name,
                             double voxel_m) {
  for (const openvdb::GridBase::Ptr& base : grids) {
    if (base->getName() != name) continue;
    const typename Grid::Ptr grid = openvdb::gridPtrCast<Grid>(base);
    if (!grid) {
      throw Refusal{ErrorCode::kDataLoss, fmt::format("grid {} is of another type", name)};
    }
    if (std::abs(grid->voxelSize().x() - voxel_m) > 1e-9) {
      throw Refusal{
          ErrorCode::kDataLoss,
          fmt::format(
              "grid {} has voxels of {} m, not of {} m", name, grid->voxelSize().x(), voxel_m)};
    }
    if (grid->activeVoxelCount() > kMaxBlocks * Block::kVoxels) {
      throw Refusal{ErrorCode::kResourceExhausted,
                    fmt::format("grid {} has {} voxels, more than {}",
                                name,
                                grid->activeVoxelCount(),
                                kMaxBlocks * Block::kVoxels)};
    }
    // Another tool may have made one tile of many equal voxels.
    grid->tree().voxelizeActiveTiles();
    return grid;
  }
  throw Refusal{ErrorCode::kDataLoss, fmt::format("grid {} is missing in it", name)};
}

/// take(block, place, value) of every active voxel.
template <typename Grid, typename Take>
void read_into(SemanticVolume& volume,
               const openvdb::GridPtrVec& grids,
               const std::string& name,
               const Take& take) {
  const auto grid = find_grid<Grid>(grids, name, volume.shape().voxel_m);
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    VoxelBlock& block = volume.add_block(SemanticVolume::block_of(voxel_of(leaf->origin())));
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      take(block, place_of(value.pos()), *value);
    }
  }
}

std::vector<std::string> class_names_of(const openvdb::MetaMap& meta) {
  std::vector<std::string> names;
  std::istringstream lines(value_of<std::string>(meta, kClassesKey));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || std::ranges::find(names, line) != names.end()) {
      throw Refusal{ErrorCode::kDataLoss,
                    fmt::format("class name '{}' is empty or there twice", line)};
    }
    names.push_back(line);
  }
  if (names.size() > static_cast<std::size_t>(kMaxClasses)) {
    throw Refusal{ErrorCode::kDataLoss,
                  fmt::format("{} classes, expected up to {}", names.size(), kMaxClasses)};
  }
  return names;
}

VolumeSummary summary_of(const openvdb::MetaMap& meta) {
  if (!meta.getMetadata<openvdb::Int32Metadata>(kFormatKey)) {
    throw Refusal{ErrorCode::kInvalidArgument, "an OpenVDB file, but not one of `semview fuse`"};
  }
  if (const int format = value_of<std::int32_t>(meta, kFormatKey); format != kFormat) {
    throw Refusal{ErrorCode::kUnimplemented,
                  fmt::format("format {}, this version reads {}", format, kFormat)};
  }
  VolumeSummary summary;
  summary.shape = {value_of<double>(meta, kVoxelKey), value_of<double>(meta, kTruncationKey)};
  if (Status status = validate(summary.shape); !status) {
    throw Refusal{ErrorCode::kDataLoss, status.error().message};
  }
  summary.classes = ClassTable(class_names_of(meta));
  summary.frames = static_cast<std::uint64_t>(value_of<std::int64_t>(meta, kFramesKey));
  summary.skipped = static_cast<std::uint64_t>(value_of<std::int64_t>(meta, kSkippedKey));
  summary.source = value_of<std::string>(meta, kSourceKey);
  return summary;
}

StoredVolume volume_of(const openvdb::MetaMap& meta, const openvdb::GridPtrVec& grids) {
  VolumeSummary summary = summary_of(meta);
  StoredVolume stored{SemanticVolume(summary.shape, std::move(summary.classes)),
                      summary.frames,
                      summary.skipped,
                      std::move(summary.source)};
  const auto names = stored.volume.classes().names();
  SemanticVolume& volume = stored.volume;
  read_into<openvdb::FloatGrid>(
      volume, grids, kDistance, [](Block& b, std::size_t p, float value) { b.sdf_m[p] = value; });
  read_into<openvdb::FloatGrid>(
      volume, grids, kWeight, [](Block& b, std::size_t p, float value) { b.weight[p] = value; });
  for (std::size_t c = 1; c <= names.size(); ++c) {
    read_into<openvdb::Int32Grid>(
        volume, grids, kCount + names[c - 1], [c](Block& b, std::size_t p, std::int32_t value) {
          b.count(
              p, static_cast<ClassId>(c), static_cast<std::uint16_t>(std::clamp(value, 0, 65535)));
        });
  }
  read_into<openvdb::Vec3SGrid>(
      volume, grids, kColour, [](Block& b, std::size_t p, const openvdb::Vec3s& value) {
        if (b.colour.empty()) {
          b.colour.assign(Block::kVoxels, Eigen::Vector3f::Zero());
          b.colour_weight.assign(Block::kVoxels, 0.0F);
        }
        b.colour[p] = {value.x(), value.y(), value.z()};
      });
  read_into<openvdb::FloatGrid>(
      volume, grids, kColourWeight, [](Block& b, std::size_t p, float value) {
        if (!b.colour_weight.empty()) b.colour_weight[p] = value;
      });
  return stored;
}

}  // namespace

Status write_vdb(const std::filesystem::path& path, const StoredVolume& stored) {
  openvdb::initialize();
  std::filesystem::path beside = path;
  beside += ".part";
  try {
    openvdb::io::File file(beside.string());
    file.write(grids_of(stored.volume), metadata_of(stored));
    file.close();
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be written: {}", path.string(), error.what()));
  }
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (!error) return {};
  return fail(ErrorCode::kUnavailable,
              fmt::format("{}: cannot be written: {}", path.string(), error.message()));
}

namespace {

/// What `read` makes of the opened file.
/// @param delayed  Voxels stay on disk until they are asked for; a cut file is not found out then.
template <typename T, typename Read>
Result<T> read_file(const std::filesystem::path& path, bool delayed, const Read& read) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such file", path.string()));
  }
  openvdb::initialize();
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    return fail(code, fmt::format("{}: {}", path.string(), what));
  };
  try {
    openvdb::io::File file(path.string());
    file.open(delayed);
    return read(file);
  } catch (const Refusal& refusal) {
    return refuse(refusal.code, refusal.what);
  } catch (const std::exception& error) {
    return refuse(ErrorCode::kInvalidArgument,
                  fmt::format("cannot be read as an OpenVDB file: {}", error.what()));
  }
}

}  // namespace

Result<StoredVolume> read_vdb(const std::filesystem::path& path) {
  return read_file<StoredVolume>(path, false, [](openvdb::io::File& file) {
    return volume_of(*file.getMetadata(), *file.getGrids());
  });
}

Result<VolumeSummary> read_vdb_summary(const std::filesystem::path& path) {
  return read_file<VolumeSummary>(
      path, true, [](openvdb::io::File& file) { return summary_of(*file.getMetadata()); });
}

}  // namespace semview::field
