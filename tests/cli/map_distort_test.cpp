// SPDX-License-Identifier: Apache-2.0
// `semview map rectify` with what `semview localize --estimate-map-affine --json` has found.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/paths.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/tutorial";

class MapRectifyTest : public semview::testing::SemviewRuns {
 protected:
  int rectify(const std::string& json) {
    const std::string found = folder_.write("found.json", json).string();
    return run({"map", "rectify", kMap, "--affine", found, "-o", file("straight")});
  }
};

TEST_F(MapRectifyTest, TakesWhatTheLastFrameSaysOfTheMap) {
  ASSERT_EQ(rectify(R"({"a": 3, "b": 3, "k": 1,
                        "last": {"map": {"scale_x": 1.25, "scale_y": 0.8, "shear": 0.0}}})"),
            0)
      << errors_;
  EXPECT_THAT(output_, HasSubstr("[[0.8, 0], [0, 1.25]]"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "straight/map.yaml"));
}

TEST_F(MapRectifyTest, DistortTellsScriptsHowPointsMove) {
  ASSERT_EQ(run({"map",
                 "distort",
                 kMap,
                 "--scale",
                 "1.5,0.5",
                 "--shear",
                 "0.25",
                 "-o",
                 file("sketch"),
                 "--json"}),
            0)
      << errors_;
  const auto json = nlohmann::json::parse(output_);
  EXPECT_EQ(json["map"], file("sketch"));
  EXPECT_EQ(json["moved_by"], nlohmann::json::parse("[[1.5, 0.0], [0.25, 0.5]]"));
}

TEST_F(MapRectifyTest, OtherJsonIsRefusedInOneLine) {
  for (const char* const json :
       {R"({"a": 1.1, "b": 1, "k": 0})", R"({"last": {"map": {"scale_x": 1.1}}})", "[1, 2]", "1"}) {
    EXPECT_EQ(rectify(json), 2) << json;
    EXPECT_THAT(errors_, HasSubstr("found.json: does not say them, expected the JSON of"));
  }
  EXPECT_EQ(rectify("{"), 2);
  EXPECT_THAT(errors_, HasSubstr("found.json: is not JSON"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "straight"));
}

}  // namespace
}  // namespace semview
