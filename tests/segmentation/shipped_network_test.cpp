// SPDX-License-Identifier: Apache-2.0
// The shipped network on a real photograph, and on pictures drawn of a shipped building.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/io/observation_folder.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

const PanoramaCamera kProfile{360, 90, -kPi / 4.0, kPi / 4.0};

class ShippedNetworkTest : public testing::SemviewRuns {
 protected:
  /// The class that an observation has most often in a window of 5 x 5 degrees.
  std::string seen_at(const Observation& seen, double azimuth_deg, double elevation_deg) {
    const int row = kProfile.row_of(rad_from_deg(elevation_deg));
    const int column = kProfile.column_of(rad_from_deg(azimuth_deg));
    std::array<int, 256> counts{};
    for (int r = row - 2; r <= row + 2; ++r) {
      for (int c = column - 2; c <= column + 2; ++c) ++counts[seen.labels.at(r, c)];
    }
    const auto most = std::max_element(counts.begin(), counts.end()) - counts.begin();
    return std::string(seen.classes.name(static_cast<ClassId>(most)));
  }
};

TEST_F(ShippedNetworkTest, SeesWhatIsInARealLivingRoom) {
  ASSERT_EQ(run({"observe",
                 SEMVIEW_SOURCE_DIR "/tests/data/panoramas/lebombo_1k.jpg",
                 "--equirectangular",
                 "-o",
                 file("obs")}),
            0)
      << errors_;
  const Result<Observation> seen = io::read_observation(file("obs"), kProfile);
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ(seen_at(*seen, 16.0, -8.0), "door");
  EXPECT_EQ(seen_at(*seen, -40.0, -5.0), "windowpane");
  EXPECT_EQ(seen_at(*seen, -110.0, 10.0), "wall");
  EXPECT_EQ(seen_at(*seen, 90.0, 10.0), "wall");
  EXPECT_EQ(seen_at(*seen, -20.0, -41.0), "floor");
  EXPECT_EQ(seen_at(*seen, 130.0, -40.0), "floor");
  EXPECT_EQ(seen_at(*seen, -30.0, 42.0), "ceiling");
}

// Drawn pictures are none that a network has learned from. What agrees is printed, and under 0.5 it
// is a demonstration of the way through the programs and no evidence of anything else.
TEST_F(ShippedNetworkTest, AgreementOnPicturesDrawnOfABuildingIsPrinted) {
  const std::string map = SEMVIEW_SOURCE_DIR "/maps/duplex_building";
  for (const char* pose : {"4.55,-13.25,0", "2.05,-5.05,90", "6.55,-3.55,180"}) {
    ASSERT_EQ(run({"view",
                   map,
                   "--pose",
                   pose,
                   "--columns",
                   "1080",
                   "--rows",
                   "540",
                   "--elevation=-90,90",
                   "--photo",
                   file("photo.png")}),
              0)
        << errors_;
    ASSERT_EQ(run({"observe", file("photo.png"), "--equirectangular", "-o", file("obs"), "--json"}),
              0)
        << errors_;
    EXPECT_GT(nlohmann::json::parse(output_)["known_share"].get<double>(), 0.5);
    ASSERT_EQ(run({"score",
                   map,
                   "--obs",
                   file("obs"),
                   "--weights",
                   "identity",
                   "--pose",
                   pose,
                   "--json"}),
              0)
        << errors_;
    fmt::print("{}: {}\n", pose, output_);
  }
}

}  // namespace
}  // namespace semview
