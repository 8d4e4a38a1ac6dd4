// SPDX-License-Identifier: Apache-2.0
// `semview localize --model` as a person or script calls it: a plan is all the map there is, the
// depth camera drives through the building as it was designed.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/geometry/angle.hpp"
#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/trajectory.hpp"
#include "support/depth_log.hpp"
#include "support/paths.hpp"
#include "support/running_server.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using semview::testing::Arguments;
using semview::testing::file_bytes;
using ::testing::HasSubstr;

const std::string kMaps = SEMVIEW_SOURCE_DIR "/maps/";
const std::string kPlan = kMaps + "duplex_level1";
const std::string kMesh = kMaps + "duplex_building";

class LocalizeDepthTest : public semview::testing::SemviewRuns {
 protected:
  void record(int steps) {
    ASSERT_EQ(run({"simulate",
                   kPlan,
                   "--out",
                   file("drive"),
                   "--seed",
                   "3",
                   "--steps",
                   std::to_string(steps)}),
              0)
        << errors_;
    const auto driven = io::read_run_log(folder_ / "drive");
    ASSERT_TRUE(driven) << driven.error().message;
    truth_ = *driven->groundtruth;
    testing::record_depth_log(*driven, kMesh, folder_ / "log");
  }

  /// 0.3 m and 10 degrees uncertain.
  std::string known_start() const {
    const Pose2& pose = truth_.front().pose;
    return fmt::format("{:.3f},{:.3f},{:.1f},0.3", pose.x_m, pose.y_m, deg_from_rad(pose.yaw_rad));
  }

  Arguments localize(const std::string& output, const Arguments& more) const {
    Arguments all{"localize", "--log", file("log"), "--map", kPlan, "-o", file(output)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Arguments from_known_start(const std::string& output, const Arguments& more) const {
    Arguments all = localize(output, {"--init", known_start(), "--particles", "300"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  /// Over the whole track.
  double mean_error_m(const std::string& track) const {
    const auto poses = io::read_tum(folder_ / track);
    if (!poses || poses->empty()) return 1e9;
    double sum_m = 0.0;
    for (const io::StampedPose2& one : *poses) {
      sum_m += distance_m(one.pose, *io::interpolate(truth_, one.stamp_s));
    }
    return sum_m / static_cast<double>(poses->size());
  }

  std::vector<io::StampedPose2> truth_;
};

class EachModelTest : public LocalizeDepthTest,
                      public ::testing::WithParamInterface<const char*> {};

TEST_P(EachModelTest, FollowsTheRobotFromAKnownStart) {
  record(12);
  Arguments model{"--model", GetParam()};
  const bool mixed = model.back() == "mixed";
  if (mixed) model.insert(model.end(), {"--weights", "identity", "--eye-height", "0.9"});
  ASSERT_EQ(run(from_known_start("est.tum", model)), 0) << errors_;
  // The plan leaves out what stands on it, and the start was 0.3 m uncertain.
  EXPECT_LT(mean_error_m("est.tum"), 0.35);
  EXPECT_THAT(errors_, HasSubstr(mixed ? "weights: identity" : "distances (of the plan)"));
}

INSTANTIATE_TEST_SUITE_P(Models,
                         EachModelTest,
                         ::testing::Values("sdf", "sem", "sdf_sem", "mixed"));

TEST_F(LocalizeDepthTest, FromAnUnknownStartTheRobotIsFoundInOneOfTwoLikeFlats) {
  record(20);
  ASSERT_EQ(run(localize("est.tum", {"--model", "sdf_sem", "--global"})), 0) << errors_;
  const auto poses = io::read_tum(folder_ / "est.tum");
  ASSERT_TRUE(poses && !poses->empty());
  const Pose2 truth = *io::interpolate(truth_, poses->back().stamp_s);
  // The flats are half turns of each other, and depth with so wide sigmas does not tell which.
  const Pose2 in_the_other{8.9 - truth.x_m, -17.8 - truth.y_m, wrap_angle(truth.yaw_rad + kPi)};
  EXPECT_LT(
      std::min(distance_m(poses->back().pose, truth), distance_m(poses->back().pose, in_the_other)),
      0.3);
}

TEST_F(LocalizeDepthTest, OneSeedMakesOneTrackForAnyNumberOfThreads) {
  record(3);
  for (const char* threads : {"1", "2"}) {
    const Arguments more{"--model", "sdf_sem", "--threads", threads};
    ASSERT_EQ(run(from_known_start(std::string(threads) + ".tum", more)), 0) << errors_;
  }
  EXPECT_FALSE(file_bytes(folder_ / "1.tum").empty());
  EXPECT_EQ(file_bytes(folder_ / "1.tum"), file_bytes(folder_ / "2.tum"));
  EXPECT_EQ(file_bytes(folder_ / "1.particles.csv"), file_bytes(folder_ / "2.particles.csv"));
}

class ServedModelTest : public LocalizeDepthTest,
                        public ::testing::WithParamInterface<const char*> {};

TEST_P(ServedModelTest, AServerScoresToTheSameBytes) {
  record(3);
  const testing::RunningServer server({"--map", kPlan, "--bind", "tcp://127.0.0.1:*"},
                                      folder_ / "server");
  Arguments arguments =
      from_known_start("here.tum", {"--model", GetParam(), "--movable", "--sigma-sem", "0.8"});
  if (GetParam() == std::string("mixed")) {
    arguments.insert(arguments.end(), {"--weights", "identity"});
  }
  ASSERT_EQ(run(arguments), 0) << errors_;
  arguments[4] = "duplex_level1";
  arguments[6] = file("there.tum");
  arguments.insert(arguments.end(), {"--server", server.endpoint()});
  ASSERT_EQ(run(arguments), 0) << errors_;
  EXPECT_FALSE(file_bytes(folder_ / "here.tum").empty());
  EXPECT_EQ(file_bytes(folder_ / "here.tum"), file_bytes(folder_ / "there.tum"));
  EXPECT_EQ(file_bytes(folder_ / "here.particles.csv"),
            file_bytes(folder_ / "there.particles.csv"));
}

INSTANTIATE_TEST_SUITE_P(Models, ServedModelTest, ::testing::Values("sdf_sem", "mixed"));

TEST_F(LocalizeDepthTest, FramesWithoutAnythingToScoreArePlayedByOdometry) {
  record(4);
  const LabelImage unnamed(48, 64, kUnknown);
  ASSERT_TRUE(io::write_png(folder_ / "log/labels/000001.png", unnamed));
  const Image<std::uint16_t> unmeasured(48, 64, 0);
  ASSERT_TRUE(io::write_png(folder_ / "log/depth/000002.png", unmeasured));
  for (const auto& [model, unseen] : {std::pair("sem", "2 unseen"), std::pair("sdf", "1 unseen")}) {
    ASSERT_EQ(run(from_known_start("est.tum", {"--model", model})), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr(unseen));
    EXPECT_THAT(errors_, HasSubstr("frame 2: "));
  }
}

TEST_F(LocalizeDepthTest, WhatCannotBeginSaysWhyInOneLine) {
  record(2);
  const auto refused = [&](const Arguments& more, const char* reason) {
    EXPECT_NE(run(from_known_start("est.tum", more)), 0);
    EXPECT_THAT(errors_, HasSubstr(reason));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "est.tum"));
  };
  refused({"--model", "sfd"}, "--model");
  refused({"--z-sdf", "0.2"}, "--z-sdf: needs a --model of depth, not views");
  refused({"--model", "sdf", "--sigma-sdf", "0"}, "sigma");
  refused({"--model", "sdf", "--max-depth", "-1"}, "-1");
  refused({"--model", "mixed", "--effective-pixels", "5000"}, "effective-pixels 5000");
  refused({"--model", "mixed", "--power", "3"}, "--power: needs --model views, not mixed");
  refused({"--model", "sdf", "--kappa", "30"}, "--kappa: needs --model views or mixed, not sdf");

  Arguments on_mesh = from_known_start("est.tum", {"--model", "sdf"});
  on_mesh[4] = kMesh;
  EXPECT_EQ(run(on_mesh), 1);
  EXPECT_THAT(errors_, HasSubstr("map duplex_building is a mesh without a volume"));

  Arguments of_panoramas = from_known_start("est.tum", {"--model", "sdf"});
  of_panoramas[2] = file("drive");
  EXPECT_EQ(run(of_panoramas), 1);
  EXPECT_THAT(errors_, HasSubstr("expected `pinhole`: depth is that of a pinhole camera"));

  folder_.write("log/frames.csv", "timestamp,labels,depth,image\n0,labels/000000.png,,\n");
  EXPECT_EQ(run(from_known_start("est.tum", {"--model", "sdf"})), 1);
  EXPECT_THAT(errors_, HasSubstr("frames.csv: no frame has a depth image"));
}

}  // namespace
}  // namespace semview
