// SPDX-License-Identifier: Apache-2.0
// `semview heatmap --model` as a person or script calls it.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "semview/geometry/angle.hpp"
#include "semview/io/png.hpp"
#include "semview/io/run_log.hpp"
#include "server/room.hpp"
#include "support/depth_log.hpp"
#include "support/running_server.hpp"
#include "support/semview_runs.hpp"

namespace semview {
namespace {

using nlohmann::json;
using semview::testing::Arguments;
using semview::testing::file_bytes;
using ::testing::HasSubstr;

/// In a room of 4 m × 3 m with a table, the robot at the centre of a cell.
class HeatmapDepthTest : public semview::testing::SemviewRuns {
 protected:
  HeatmapDepthTest() : room_(test::write_room(folder_.path(), "room").string()) {
    io::RunLog driven;
    driven.frames = {{0.5, {}, {}, {}}, {1.5, {}, {}, {}}};
    driven.groundtruth = std::vector<io::StampedPose2>{{0.5, truth_}, {1.5, truth_}};
    driven.odometry = *driven.groundtruth;
    testing::record_depth_log(driven, room_, folder_ / "log");
  }

  Arguments heatmap(const Arguments& more) const {
    Arguments all{"heatmap", room_, "--obs", file("log"), "--frame", "0", "-o", file("heat.png")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  const Pose2 truth_{3.05, 2.25, rad_from_deg(-135.0)};  // looks across the table
  std::string room_;
};

TEST_F(HeatmapDepthTest, ThreeModelsStandSideBySideWithTheTruthMarked) {
  ASSERT_EQ(run(heatmap({"--model", "sdf,sem,sdf_sem", "--headings", "16", "--json"})), 0)
      << errors_;
  const json about = json::parse(output_);
  ASSERT_EQ(about.size(), 3U);
  EXPECT_EQ(about[0]["model"], "sdf");
  EXPECT_EQ(about[2]["model"], "sdf_sem");
  for (const json& one : about) {
    EXPECT_EQ(one["quantity"], "mean log p");
    EXPECT_NEAR(one["truth"]["yaw_deg"].get<double>(), -135.0, 1e-6);
    EXPECT_LE(one["best"]["similarity"].get<double>(), 0.0);
  }
  // The room looks alike from its other corner, but for the table.
  EXPECT_LT(about[2]["best"]["from_truth_m"].get<double>(), 0.2);
  const auto picture = io::read_png_rgb(folder_ / "heat.png");
  ASSERT_TRUE(picture);
  EXPECT_GT(picture->columns(), 1500);
}

TEST_F(HeatmapDepthTest, AllHeadingsOrOneAreTried) {
  ASSERT_EQ(run(heatmap({"--model", "sdf_sem", "--heading", "-134", "--json"})), 0) << errors_;
  const json right = json::parse(output_);
  EXPECT_NEAR(right["best"]["yaw_deg"].get<double>(), -135.0, 1e-6);
  EXPECT_LT(right["best"]["from_truth_m"].get<double>(), 0.15);
  ASSERT_EQ(run(heatmap({"--model", "sdf_sem", "--heading", "45", "--json"})), 0) << errors_;
  const json wrong = json::parse(output_);
  EXPECT_LT(wrong["best"]["similarity"], right["best"]["similarity"]);
  ASSERT_EQ(run(heatmap({"--model", "sdf_sem", "--posterior", "--json"})), 0) << errors_;
  const json posterior = json::parse(output_);
  EXPECT_EQ(posterior["quantity"], "probability");
  EXPECT_EQ(posterior["weighting"], (json{{"transform", "exponential"}, {"kappa", 300.0}}));
}

TEST_F(HeatmapDepthTest, AServersValuesHaveTheBytesOfThoseMadeHere) {
  const testing::RunningServer server({"--map", room_, "--bind", "tcp://127.0.0.1:*"},
                                      folder_ / "server");
  for (const Arguments& how : {Arguments{"--headings", "24"}, Arguments{"--posterior"}}) {
    Arguments arguments = heatmap({"--model", "sem", "--npy", file("here.npy")});
    arguments.insert(arguments.end(), how.begin(), how.end());
    ASSERT_EQ(run(arguments), 0) << errors_;
    arguments[1] = "room";
    arguments[11] = file("there.npy");
    arguments.insert(arguments.end(), {"--server", server.endpoint()});
    ASSERT_EQ(run(arguments), 0) << errors_;
    EXPECT_FALSE(file_bytes(folder_ / "here.npy").empty());
    EXPECT_EQ(file_bytes(folder_ / "here.npy"), file_bytes(folder_ / "there.npy"));
  }
}

TEST_F(HeatmapDepthTest, WhatCannotBeComparedSaysWhyInOneLine) {
  const auto refused = [&](const Arguments& more, const char* reason) {
    EXPECT_EQ(run(heatmap(more)), 2) << reason;
    EXPECT_THAT(errors_ + output_, HasSubstr(reason));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "heat.png"));
  };
  refused({}, "--weights: is required to compare views");
  refused({"--model", "sdf,views"}, "--model: `views` stands alone");
  refused({"--model", "sdf", "--weights", "identity"}, "--weights: needs --model views, not sdf");
  refused({"--model", "sdf,sem", "--npy", file("a.npy")}, "--npy: holds the values of one model");
  refused({"--weights", "identity", "--heading", "3"}, "--heading: needs a --model of depth");
  refused({"--weights", "identity", "--movable"}, "--movable: needs a --model of depth");
  refused({"--model", "sdf", "--headings", "121"}, "--headings 121");
  Arguments past = heatmap({"--model", "sdf"});
  past[5] = "7";
  EXPECT_EQ(run(past), 2);
  EXPECT_THAT(errors_, HasSubstr("is a run log of 2 frames; expected --frame 0 to 1"));
  const Image<std::uint16_t> unmeasured(48, 64, 0);
  ASSERT_TRUE(io::write_png(folder_ / "log/depth/000000.png", unmeasured));
  refused({"--model", "sdf"}, "--frame 0: shows nothing that model sdf looks at");
}

}  // namespace
}  // namespace semview
