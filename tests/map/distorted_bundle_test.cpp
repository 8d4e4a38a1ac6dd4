// SPDX-License-Identifier: Apache-2.0
#include "semview/map/distorted_bundle.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "semview/map/distortion.hpp"
#include "semview/map/map_checker.hpp"
#include "service/small_map.hpp"

namespace semview::map {
namespace {

class DistortedBundleTest : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  const std::filesystem::path map_ = testing::write_small_map(folder_);
};

TEST_F(DistortedBundleTest, LoadsWithTheFingerprintOfTheDistortedMap) {
  std::ofstream(map_ / "weights.csv") << "observed,wall\n";
  for (const MapAffine& affine :
       {MapAffine{1.2, 0.83, 0.0}, MapAffine{1.0, 1.0, 0.3}, MapAffine{0.7, 1.4, -0.5}}) {
    const std::filesystem::path out = folder_ / fmt::format("out_{}", affine.a);
    const Status written = write_distorted(map_, affine, out);
    ASSERT_TRUE(written) << written.error().message;
    const SemanticMap expected = *distort(*load_map(map_), affine);
    const auto loaded = load_map(out);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->fingerprint, expected.fingerprint);
    EXPECT_EQ(loaded->class_details, expected.class_details);
    EXPECT_TRUE(std::filesystem::exists(out / "occupancy.png"));
    EXPECT_TRUE(std::filesystem::exists(out / "weights.csv"));
    EXPECT_FALSE(check_map(out).report.has_errors());
  }
}

TEST_F(DistortedBundleTest, TheWayBackEndsWhereItBegan) {
  const MapAffine affine{1.3, 0.8, 0.25};
  ASSERT_TRUE(write_distorted(map_, affine, folder_ / "sketch"));
  ASSERT_TRUE(write_distorted(folder_ / "sketch", inverse(affine), folder_ / "straight"));
  const auto before = load_map(map_);
  const auto after = load_map(folder_ / "straight");
  ASSERT_TRUE(before && after);
  int same = 0;
  int all = 0;
  for (int row = 0; row < before->columns()->rows(); ++row) {
    for (int column = 0; column < before->columns()->columns(); ++column) {
      const Eigen::Vector2d center = before->columns()->pixel_center({row, column});
      const ColumnProfile* there = after->columns()->at(center.x(), center.y());
      ++all;
      same += there != nullptr && there->slabs == before->columns()->profile(row, column).slabs;
    }
  }
  EXPECT_GT(same, 0.85 * all);  // nearest cells, twice
}

TEST_F(DistortedBundleTest, DoesNotWriteOverAMap) {
  const Status written = write_distorted(map_, {1.2, 1.0, 0.0}, map_);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kAlreadyExists);
}

}  // namespace
}  // namespace semview::map
