// SPDX-License-Identifier: Apache-2.0
#include "semview/field/vdb_file.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::field {
namespace {

StoredVolume small_volume() {
  StoredVolume stored{SemanticVolume(VolumeShape{0.04, 0.12}, ClassTable({"wall", "coffee table"})),
                      17,
                      3,
                      "a log"};
  for (const SemanticVolume::BlockIndex index : {VoxelIndex{-1, 0, 2}, VoxelIndex{3, -4, 0}}) {
    VoxelBlock& block = stored.volume.add_block(index);
    for (std::size_t p = 0; p < VoxelBlock::kVoxels; p += 3) {
      block.sdf_m[p] = 0.12F - 0.0004F * static_cast<float>(p);
      block.weight[p] = 1.0F + static_cast<float>(p % 7);
      if (p % 2 == 0) block.count(p, static_cast<ClassId>(1 + p % 4 / 2), 5);
    }
  }
  VoxelBlock& coloured = *stored.volume.block({3, -4, 0});
  coloured.colour.assign(VoxelBlock::kVoxels, Eigen::Vector3f::Zero());
  coloured.colour_weight.assign(VoxelBlock::kVoxels, 0.0F);
  coloured.colour[9] = {10.0F, 20.5F, 255.0F};
  coloured.colour_weight[9] = 4.0F;
  return stored;
}

void expect_equal(const SemanticVolume& a, const SemanticVolume& b) {
  EXPECT_EQ(a.shape(), b.shape());
  EXPECT_EQ(a.classes(), b.classes());
  ASSERT_EQ(a.block_indices(), b.block_indices());
  for (const auto& index : a.block_indices()) {
    EXPECT_EQ(a.block(index)->sdf_m, b.block(index)->sdf_m);
    EXPECT_EQ(a.block(index)->weight, b.block(index)->weight);
    for (std::size_t p = 0; p < VoxelBlock::kVoxels; ++p) {
      EXPECT_EQ(a.block(index)->most_likely_class(p), b.block(index)->most_likely_class(p));
    }
    EXPECT_EQ(a.block(index)->colour, b.block(index)->colour);
    EXPECT_EQ(a.block(index)->colour_weight, b.block(index)->colour_weight);
  }
}

TEST(VdbFileTest, AVolumeIsReadAsItWasWritten) {
  const testing::TemporaryFolder folder;
  const StoredVolume stored = small_volume();
  ASSERT_TRUE(write_vdb(folder.path() / "volume.vdb", stored));
  const auto read = read_vdb(folder.path() / "volume.vdb");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frames, 17U);
  EXPECT_EQ(read->skipped, 3U);
  EXPECT_EQ(read->source, "a log");
  expect_equal(read->volume, stored.volume);
  const auto summary = read_vdb_summary(folder.path() / "volume.vdb");
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->shape, stored.volume.shape());
  EXPECT_EQ(summary->classes, stored.volume.classes());
  EXPECT_EQ(summary->frames, 17U);
}

TEST(VdbFileTest, AFileCutAnywhereIsAnErrorThatNamesIt) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "volume.vdb";
  ASSERT_TRUE(write_vdb(path, small_volume()));
  const auto whole = std::filesystem::file_size(path);
  for (const auto bytes :
       {whole - 1, whole / 2, whole / 10, std::uintmax_t{3}, std::uintmax_t{0}}) {
    std::filesystem::resize_file(path, bytes);
    const auto read = read_vdb(path);
    ASSERT_FALSE(read) << bytes << " of " << whole;
    EXPECT_NE(read.error().message.find("volume.vdb"), std::string::npos);
  }
}

TEST(VdbFileTest, WhatIsNoVdbFileIsRefused) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "volume.vdb";
  std::ofstream(path) << "a text that somebody gave the wrong name, long enough for a header";
  const auto read = read_vdb(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(read_vdb(folder.path() / "none.vdb").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace semview::field
