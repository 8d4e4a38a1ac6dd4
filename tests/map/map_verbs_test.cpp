// SPDX-License-Identifier: Apache-2.0
/// The built program: exit codes and what scripts read.
#include <array>
#include <cstdio>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "map/bundle.hpp"
#include "semview/io/png.hpp"
#include "support/paths.hpp"

namespace semview::map {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::TempFolder;
using testing::write_bundle;

struct Outcome {
  int exit_code = -1;
  std::string output;  ///< both streams
};

Outcome semview_map(const std::string& arguments) {
  const std::string command =
      fmt::format("\"{}/semview\" map {} 2>&1", SEMVIEW_BINARY_DIR, arguments);
  Outcome run;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return run;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
    run.output.append(block.data(), count);
  }
  const int status = ::pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

class MapVerbsTest : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  TempFolder folder_;
};

TEST_F(MapVerbsTest, CheckExitsWith0Or1Or2) {
  write_bundle(folder_ / "good", room());
  write_bundle(
      folder_ / "bad", room(), replaced(map_yaml(), "min_height: 0.7,", "min_height: 2.4,"));
  EXPECT_EQ(semview_map("check " + at("good")).exit_code, 0);
  const Outcome bad = semview_map("check " + at("good") + " " + at("bad"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.output, HasSubstr(at("bad") + "/map.yaml:19: error: min_height 2.4"));
  EXPECT_EQ(semview_map("check").exit_code, 2);
  EXPECT_EQ(semview_map("check --no-such-option").exit_code, 2);
}

TEST_F(MapVerbsTest, CheckFindsTwoMapsWithOneId) {
  write_bundle(folder_ / "a", room());
  write_bundle(folder_ / "b", room());
  const Outcome run = semview_map("check --json " + at("a") + " " + at("b"));
  EXPECT_EQ(run.exit_code, 1);
  const json report = json::parse(run.output);
  ASSERT_EQ(report.size(), 2U);
  EXPECT_TRUE(report[0]["ok"].get<bool>());
  EXPECT_FALSE(report[1]["ok"].get<bool>());
  EXPECT_THAT(report[1]["problems"][0]["message"].get<std::string>(), HasSubstr("test_room"));
}

TEST_F(MapVerbsTest, InfoNamesWhatAServerNeeds) {
  const Outcome run = semview_map("info --json " SEMVIEW_SOURCE_DIR "/maps/tutorial");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json info = json::parse(run.output);
  EXPECT_EQ(info["id"], "tutorial");
  EXPECT_EQ(info["fingerprint"].get<std::string>().size(), 32U);
  EXPECT_GT(info["free_cells"].get<int>(), 2000);
  EXPECT_EQ(info["classes"][0]["name"], "ceiling");
  EXPECT_EQ(info["engine"], "embree");
}

TEST_F(MapVerbsTest, InfoOfAMeshMapCountsFreeCells) {
  const Outcome run = semview_map("info --json " SEMVIEW_SOURCE_DIR "/maps/duplex_building");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json info = json::parse(run.output);
  EXPECT_EQ(info["kind"], "mesh");
  EXPECT_GT(info["free_cells"].get<int>(), 5000);
}

TEST_F(MapVerbsTest, PreviewAndOccupancyWritePictures) {
  write_bundle(folder_ / "map", room());
  ASSERT_EQ(semview_map("preview " + at("map") + " -o " + at("plan.png")).exit_code, 0);
  EXPECT_TRUE(io::read_png_rgb(folder_ / "plan.png"));
  ASSERT_EQ(semview_map("occupancy " + at("map")).exit_code, 0);
  EXPECT_TRUE(io::read_png_grey(folder_ / "map" / "occupancy.png"));
  const Outcome nowhere = semview_map("preview " + at("nothing") + " -o " + at("x.png"));
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_THAT(nowhere.output, HasSubstr("no such file or folder"));
}

}  // namespace
}  // namespace semview::map
