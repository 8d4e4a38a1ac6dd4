// SPDX-License-Identifier: Apache-2.0
// The Khronos glTF validator as judge of what `semview map export` writes of every shipped map.
// Needs npm and, once, its registry.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/furnished_room.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/gltf_write.hpp"
#include "support/paths.hpp"
#include "support/run_program.hpp"
#include "support/temporary_folder.hpp"

namespace semview::map {
namespace {

using semview::testing::Outcome;
using semview::testing::run_command;
using semview::testing::run_semview;
using semview::testing::TemporaryFolder;

// In the build folder, so that it is fetched once.
const std::filesystem::path kFolder =
    std::filesystem::path(SEMVIEW_BINARY_DIR).parent_path() / "gltf_validator";

/// Why the validator cannot be asked; empty if it can.
std::string missing_validator() {
  if (run_command("command -v npm >/dev/null && command -v node >/dev/null").exit_code != 0) {
    return "npm or node is not installed: the Khronos validator was not asked";
  }
  std::filesystem::create_directories(kFolder);
  // Tests run side by side: one fetches, the others wait for it.
  const std::string folder = kFolder.string();
  const Outcome fetched = run_command(
      "flock '" + folder + "/lock' sh -c \"test -d '" + folder +
      "/node_modules/gltf-validator' || npm install --no-audit --no-fund --fetch-retries 0 "
      "--prefix '" +
      folder + "' gltf-validator@2.0.0-dev.3.10\"");
  if (fetched.exit_code == 0) return {};
  return "npm could not fetch gltf-validator, the Khronos validator was not asked: " +
         fetched.output;
}

void expect_neither_errors_nor_warnings(const std::filesystem::path& glb) {
  const Outcome verdict =
      run_command("node '" SEMVIEW_SOURCE_DIR "/tests/mesh/validate_glb.mjs' '" + kFolder.string() +
                  "' '" + glb.string() + "'");
  EXPECT_EQ(verdict.exit_code, 0) << glb << ": " << verdict.output;
}

void expect_exported(const std::filesystem::path& map, const std::filesystem::path& glb) {
  const Outcome outcome = run_semview("map export '" + map.string() + "' '" + glb.string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
}

class GltfValidatorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = missing_validator(); !why.empty()) GTEST_SKIP() << why;
  }
  TemporaryFolder folder_;
};

TEST_F(GltfValidatorTest, FurnishedRoomHasNeitherErrorsNorWarnings) {
  const SemanticMap map = furnished_room();
  ASSERT_TRUE(write_glb(map, extrude(*map.columns()), folder_ / "room.glb"));
  expect_neither_errors_nor_warnings(folder_ / "room.glb");
}

TEST_F(GltfValidatorTest, FindsFaultWithADamagedFile) {
  const SemanticMap map = furnished_room();
  ASSERT_TRUE(write_glb(map, extrude(*map.columns()), folder_ / "room.glb"));
  std::string bytes = semview::testing::file_bytes(folder_ / "room.glb");
  const std::string positions = "\"POSITION\"";
  ASSERT_NE(bytes.find(positions), std::string::npos);
  bytes.replace(bytes.find(positions), positions.size(), "\"POSITIOM\"");
  folder_.write("room.glb", bytes);
  EXPECT_EQ(run_command("node '" SEMVIEW_SOURCE_DIR "/tests/mesh/validate_glb.mjs' '" +
                        kFolder.string() + "' '" + (folder_ / "room.glb").string() + "'")
                .exit_code,
            1);
}

std::vector<std::filesystem::path> shipped_maps() {
  std::vector<std::filesystem::path> maps;
  for (const auto& entry : std::filesystem::directory_iterator(SEMVIEW_SOURCE_DIR "/maps")) {
    if (entry.is_directory()) maps.push_back(entry.path());
  }
  // A mesh without a map.yaml beside it is a map, too.
  maps.emplace_back(SEMVIEW_SOURCE_DIR "/maps/duplex_building/semantic.glb");
  std::sort(maps.begin(), maps.end());
  return maps;
}

class ShippedMapExportTest : public GltfValidatorTest,
                             public ::testing::WithParamInterface<std::filesystem::path> {};

TEST_P(ShippedMapExportTest, IsValidAndSoIsItsOwnExport) {
  expect_exported(GetParam(), folder_ / "map.glb");
  expect_neither_errors_nor_warnings(folder_ / "map.glb");
  expect_exported(folder_ / "map.glb", folder_ / "again.glb");
  expect_neither_errors_nor_warnings(folder_ / "again.glb");
}

INSTANTIATE_TEST_SUITE_P(Maps,
                         ShippedMapExportTest,
                         ::testing::ValuesIn(shipped_maps()),
                         [](const auto& map) { return map.param.stem().string(); });

}  // namespace
}  // namespace semview::map
