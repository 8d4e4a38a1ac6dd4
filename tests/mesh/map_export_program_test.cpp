// SPDX-License-Identifier: Apache-2.0
// `semview map export` as a person or script calls it.
#include <filesystem>
#include <map>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/map/extrusion.hpp"
#include "semview/map/semantic_map.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview::map {
namespace {

using semview::testing::file_bytes;
using semview::testing::Outcome;
using semview::testing::run_semview;
using ::testing::HasSubstr;

const std::string kMap = SEMVIEW_SOURCE_DIR "/maps/tutorial";

/// Class name to surface in square metres.
std::map<std::string, double> areas(const SemanticMap& map, const TriangleMesh& mesh) {
  std::map<std::string, double> sums;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3f u = mesh.vertices[b] - mesh.vertices[a];
    const Eigen::Vector3f v = mesh.vertices[c] - mesh.vertices[a];
    sums[std::string(map.classes.name(mesh.labels[i]))] += 0.5 * u.cross(v).norm();
  }
  return sums;
}

class MapExportProgramTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  semview::testing::TemporaryFolder folder_;
};

TEST_F(MapExportProgramTest, WritesAMapWithTheSameSurfacesOfEachClass) {
  const Outcome outcome = run_semview("map export " + kMap + " " + file("house.glb"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("house.glb: "));
  const auto drawn = load_map(kMap);
  const auto exported = load_map(file("house.glb"));
  ASSERT_TRUE(drawn && exported);
  const auto wanted = areas(*drawn, extrude(*drawn->columns()));
  const auto found = areas(*exported, exported->mesh()->mesh);
  ASSERT_EQ(found.size(), wanted.size());
  for (const auto& [name, area] : wanted) EXPECT_NEAR(found.at(name), area, 1e-4 * area) << name;
}

TEST_F(MapExportProgramTest, RefusesANameUnderWhichItWouldBeNoMap) {
  const Outcome outcome = run_semview("map export " + kMap + " " + file("house.txt"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("house.txt: expected a name that ends in .glb"));
  EXPECT_FALSE(std::filesystem::exists(file("house.txt")));
}

TEST_F(MapExportProgramTest, WritesTheSameBytesEachTime) {
  ASSERT_EQ(run_semview("map export " + kMap + " " + file("a.glb")).exit_code, 0);
  ASSERT_EQ(run_semview("map export " + kMap + " " + file("b.glb")).exit_code, 0);
  EXPECT_EQ(file_bytes(file("a.glb")), file_bytes(file("b.glb")));
}

TEST_F(MapExportProgramTest, ExitsWith2ForWrongArguments) {
  EXPECT_EQ(run_semview("map export").exit_code, 2);
  EXPECT_EQ(run_semview("map export " + kMap).exit_code, 2);
  EXPECT_EQ(run_semview("map export --no-such-option " + kMap + " " + file("x.glb")).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(file("x.glb")));
}

TEST_F(MapExportProgramTest, ExitsWith1AndNamesTheFileThatItCannotUse) {
  const Outcome no_map = run_semview("map export " + file("nothing") + " " + file("x.glb"));
  EXPECT_EQ(no_map.exit_code, 1);
  EXPECT_THAT(no_map.output, HasSubstr(file("nothing") + ": no such file or folder"));
  EXPECT_FALSE(std::filesystem::exists(file("x.glb")));

  const Outcome no_folder = run_semview("map export " + kMap + " " + file("none/x.glb"));
  EXPECT_EQ(no_folder.exit_code, 1);
  EXPECT_THAT(no_folder.output, HasSubstr(file("none/x.glb") + ": cannot be written"));

  folder_.write("cut.glb",
                file_bytes(SEMVIEW_SOURCE_DIR "/maps/duplex_building/semantic.glb").substr(0, 999));
  const Outcome damaged = run_semview("map export " + file("cut.glb") + " " + file("x.glb"));
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_THAT(damaged.output, HasSubstr("cut.glb"));
  EXPECT_FALSE(std::filesystem::exists(file("x.glb")));
}

}  // namespace
}  // namespace semview::map
