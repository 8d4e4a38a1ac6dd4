// SPDX-License-Identifier: Apache-2.0
// `semview view` as a person or script calls it.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/png.hpp"
#include "semview/io/range_png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "support/engine_wish.hpp"
#include "support/run_program.hpp"
#include "support/running_server.hpp"
#include "support/temporary_folder.hpp"

namespace semview {
namespace {

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/duplex_level1";

class ViewVerbTest : public ::testing::Test {
 protected:
  /// Runs `semview view`, standard output and error into files; returns the exit code.
  int view(const std::string& arguments) {
    return testing::run_command("('" SEMVIEW_BINARY_DIR "/semview' view " + arguments + " >" +
                                file("out") + " 2>" + file("err") + ")")
        .exit_code;
  }
  std::string out() const { return testing::file_bytes(folder_ / "out"); }
  std::string err() const { return testing::file_bytes(folder_ / "err"); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  static raycast::Scene scene() { return std::move(*raycast::Scene::build(*map::load_map(kMap))); }

  /// What the engine that the program takes sees.
  static raycast::Panorama panorama(const raycast::PanoramaRequest& request) {
    if (testing::plan_engine() == "embree") return raycast::render_panorama(scene(), request);
    const auto map = map::load_map(kMap);
    return raycast::render_panorama(raycast::ColumnScene::build(*map->columns()), request);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(ViewVerbTest, WritesTheIdsAndMillimetresOfAPanorama) {
  ASSERT_EQ(view(kMap + " --pose 2.35,-3.05,90 --columns 240 --rows 50 --elevation -30,40" +
                 " --labels " + file("ids.png") + " --range " + file("mm.png") + " --image " +
                 file("picture.png") + " --range-image " + file("ranges.png") + " --json"),
            0)
      << err();
  const raycast::Panorama truth = panorama(
      {{2.35, -3.05, kPi / 2.0}, 1.2, {240, 50, rad_from_deg(-30.0), rad_from_deg(40.0)}, {}});
  EXPECT_EQ(io::read_png_grey(file("ids.png")).value(), truth.labels);
  EXPECT_EQ(io::read_png_grey16(file("mm.png")).value(), io::millimetres(truth.ranges_m));
  EXPECT_GT(io::png_size(file("picture.png")).value().columns, 240);
  EXPECT_GT(io::png_size(file("ranges.png")).value().columns, 240);
  EXPECT_THAT(out(), ::testing::HasSubstr("\"engine\": \"" + testing::plan_engine() + "\""));
  EXPECT_THAT(out(), ::testing::HasSubstr("\"engine_reason\": \""));
  EXPECT_THAT(out(), ::testing::HasSubstr("\"name\": \"wall\""));
}

TEST_F(ViewVerbTest, WritesAPinholeView) {
  ASSERT_EQ(view(kMap + " --pose 2.35,-3.05,90 --pinhole 100,110,60,40,121,83 --labels " +
                 file("ids.png") + " --range " + file("mm.png") + " --json"),
            0)
      << err();
  EXPECT_THAT(out(), ::testing::HasSubstr("\"engine\": \"embree\""));
  EXPECT_THAT(out(), ::testing::HasSubstr("\"pinhole views are cast by Embree\""));
  const raycast::PinholeView truth = raycast::render_pinhole(
      scene(), {level_camera({2.35, -3.05, kPi / 2.0}, 1.2), {121, 83, 100.0, 110.0, 60.0, 40.0}});
  EXPECT_EQ(io::read_png_grey(file("ids.png")).value(), truth.labels);
  EXPECT_EQ(io::read_png_grey16(file("mm.png")).value(), io::millimetres(truth.depths_m));
}

TEST_F(ViewVerbTest, ColumnsAreRefusedForAPinholeView) {
  EXPECT_EQ(view(kMap + " --pose 2,-3,90 --pinhole 100,110,60,40,121,83 --engine columns"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("--engine columns: casts panoramas only"));
}

TEST_F(ViewVerbTest, CastsThroughAnAffine) {
  ASSERT_EQ(view(kMap + " --pose 2.35,-3.05,90 --affine 1.1,0.9,0.05 --labels " + file("ids.png")),
            0)
      << err();
  const raycast::Panorama truth = panorama({{2.35, -3.05, kPi / 2.0}, 1.2, {}, {1.1, 0.9, 0.05}});
  EXPECT_EQ(io::read_png_grey(file("ids.png")).value(), truth.labels);
}

TEST_F(ViewVerbTest, TakesItsEngineFromTheOptionThenFromTheEnvironment) {
  const auto engine_of = [&](const std::string& environment, const std::string& options) {
    const testing::Outcome run =
        testing::run_command(environment + " '" SEMVIEW_BINARY_DIR "/semview' view " + kMap +
                             " --pose 2,-3,90 --columns 120 --rows 10 --json " + options);
    for (const char* name : {"columns", "embree"}) {
      const std::string field = std::string("\"engine\": \"") + name + "\"";
      if (run.output.find(field) != std::string::npos) return std::string(name);
    }
    return run.output;
  };
  EXPECT_EQ(engine_of("SEMVIEW_ENGINE=", ""), "columns");
  EXPECT_EQ(engine_of("SEMVIEW_ENGINE=embree", ""), "embree");
  EXPECT_EQ(engine_of("SEMVIEW_ENGINE=embree", "--engine columns"), "columns");
  EXPECT_EQ(engine_of("SEMVIEW_ENGINE=embree", "--engine auto"), "columns");
  EXPECT_THAT(engine_of("SEMVIEW_ENGINE=crystal", ""),
              ::testing::HasSubstr("--engine and SEMVIEW_ENGINE take auto, columns or embree"));
}

TEST_F(ViewVerbTest, ColumnsOfAMeshAreRefused) {
  EXPECT_EQ(view(SEMVIEW_SOURCE_DIR "/maps/duplex_building --pose 2,-3,90 --engine columns"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("is a mesh"));
}

TEST_F(ViewVerbTest, SaysWhatIsWrongWithAnOption) {
  EXPECT_EQ(view(kMap + " --pose 1,2"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("--pose 1,2: expected 3"));
  EXPECT_EQ(view(kMap + " --pose 2,-3,0 --columns 100"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("multiple of 120"));
  EXPECT_EQ(view(kMap + " --pose 2,-3,0 --affine 9,1,0"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("within 0.2 to 5"));
  EXPECT_EQ(view(kMap + " --pose 2,-3,0 --pinhole 100,100,1,1,64.5,48"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("whole numbers"));
  EXPECT_EQ(view("no_such_map --pose 2,-3,0"), 1);
}

TEST_F(ViewVerbTest, WarnsOfAnEyeThatIsOutsideOrInAWall) {
  EXPECT_EQ(view(kMap + " --pose 50,50,0"), 0);
  EXPECT_THAT(err(), ::testing::HasSubstr("outside the building"));
  EXPECT_EQ(view(SEMVIEW_SOURCE_DIR "/maps/tutorial --pose 0.15,0.15,0 --json"), 0);
  EXPECT_THAT(err(), ::testing::HasSubstr("the eye is inside a wall"));
  EXPECT_THAT(out(), ::testing::HasSubstr("\"engine\": \"embree\""));
}

TEST_F(ViewVerbTest, AServerCastsTheBytesThatThisProcessDoes) {
  const testing::RunningServer server({"--map", kMap, "--bind", "tcp://127.0.0.1:*"},
                                      folder_ / "server");
  const std::string there = "duplex_level1 --server " + server.endpoint();
  for (const std::string camera : {"--columns 240 --rows 50 --elevation -30,40 --eye-height 1.1",
                                   "--affine 1.1,0.9,0.1",
                                   "--pinhole 100,110,60,40,121,83"}) {
    const auto files = [this](const std::string& name) {
      return " --labels " + file(name + "_ids.png") + " --range " + file(name + "_mm.png") +
             " --image " + file(name + ".png") + " --range-image " + file(name + "_range.png");
    };
    const std::string pose = " --pose 2.35,-3.05,90 " + camera;
    ASSERT_EQ(view(kMap + pose + files("here")), 0) << err();
    ASSERT_EQ(view(there + pose + files("there")), 0) << err();
    for (const std::string end : {"_ids.png", "_mm.png", ".png", "_range.png"}) {
      EXPECT_EQ(testing::file_bytes(file("here" + end)), testing::file_bytes(file("there" + end)))
          << camera << end;
    }
  }
  EXPECT_EQ(view(there + " --pose 2.35,-3.05,90 --engine embree"), 2);
  EXPECT_THAT(err(), ::testing::HasSubstr("--engine: is the server's own choice"));
}

}  // namespace
}  // namespace semview
