// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2017/guard.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(GuardTest, CameraAndMapMayShareNeitherSceneNorRenderer) {
  const Provenance honest{"solids", "ray caster", "plan", "columns 1"};
  EXPECT_TRUE(check_provenance(honest));
  Provenance one_scene = honest;
  one_scene.observation_scene = "plan";
  const Status refused = check_provenance(one_scene);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kFailedPrecondition);
  EXPECT_THAT(refused.error().message, HasSubstr("one scene, plan"));
  Provenance one_renderer = honest;
  one_renderer.observation_renderer = "columns 1";
  EXPECT_FALSE(check_provenance(one_renderer));
}

}  // namespace
}  // namespace semview::paper2017
