// SPDX-License-Identifier: Apache-2.0
#include "semview/evaluation/particles_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::evaluation {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

TEST(ReadParticlesTest, ReadsPosesAndIgnoresFurtherColumns) {
  const TemporaryFolder folder;
  const auto path = folder.write("p.csv", "x_m,y_m,yaw_deg,weight\n1.5,-2,90,0.25\n0,0,270,0.75\n");
  const Result<std::vector<Pose2>> poses = read_particles(path);
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 2U);
  EXPECT_EQ((*poses)[0], (Pose2{1.5, -2.0, kPi / 2.0}));
  EXPECT_NEAR((*poses)[1].yaw_rad, -kPi / 2.0, 1e-12);
}

TEST(ReadParticlesTest, FaultsNameFileAndLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    return read_particles(folder.write("p.csv", text)).error().message;
  };
  EXPECT_THAT(message("x,y\n"), HasSubstr("p.csv:1: expected a header"));
  EXPECT_THAT(message("x_m,y_m,yaw_deg\n1,2\n"), HasSubstr("p.csv:2: expected the numbers"));
  EXPECT_THAT(message("x_m,y_m,yaw_deg\n1,2,3\n1,a,3\n"), HasSubstr("p.csv:3: expected"));
  EXPECT_THAT(message("x_m,y_m,yaw_deg\n1,nan,3\n"), HasSubstr("p.csv:2: a number is not finite"));
}

}  // namespace
}  // namespace semview::evaluation
