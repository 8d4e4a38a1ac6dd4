// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/guard.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/text_file.hpp"
#include "support/paths.hpp"

namespace semview::paper2017 {
namespace {

using ::testing::HasSubstr;
using Worlds = std::vector<std::uint64_t>;

TEST(GuardTest, WorldsHaveOneUse) {
  EXPECT_EQ(*check_worlds(Worlds{1, 2, 100}), WorldUse::kTest);
  EXPECT_EQ(*check_worlds(Worlds{201, 205}), WorldUse::kValidation);
}

TEST(GuardTest, NoTableIsMadeOfTrainingWorlds) {
  const auto refused = check_worlds(Worlds{101});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "--worlds");
  EXPECT_THAT(refused.error().message, HasSubstr("weights are learned on world 101"));
}

TEST(GuardTest, TestAndValidationWorldsDoNotMix) {
  const auto refused = check_worlds(Worlds{6, 201});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("6 is a test world and 201 a validation world"));
}

TEST(GuardTest, SeedsOfNoUseAndNoSeedsAreRefused) {
  EXPECT_FALSE(check_worlds(Worlds{}));
  EXPECT_FALSE(check_worlds(Worlds{0}));
  EXPECT_FALSE(check_worlds(Worlds{107}));
  EXPECT_FALSE(check_worlds(Worlds{206}));
}

// Neither code nor geometry of the map and its renderers: else an accuracy would be that of a
// renderer in predicting itself.
TEST(GuardTest, TheCamerasSourcesIncludeNothingOfMapsAndTheirRenderers) {
  const std::string folder = SEMVIEW_SOURCE_DIR "/experiments/paper2017/";
  for (const char* file : {"scene.hpp",
                           "scene.cpp",
                           "scene_builder.hpp",
                           "scene_builder.cpp",
                           "label_noise.hpp",
                           "label_noise.cpp",
                           "raw_classes.hpp",
                           "raw_classes.cpp",
                           "layout.hpp",
                           "layout.cpp"}) {
    const auto text = io::read_text_file(folder + file, std::size_t{1} << 20U);
    ASSERT_TRUE(text) << file;
    for (const char* stranger : {"semview/map/",
                                 "semview/mesh/",
                                 "semview/raycast/",
                                 "semview/service/",
                                 "plan_drawing.hpp",
                                 "row_map.hpp"}) {
      EXPECT_EQ(text->find(fmt::format("#include \"{}", stranger)), std::string::npos)
          << file << " includes " << stranger;
    }
  }
}

}  // namespace
}  // namespace semview::paper2017
