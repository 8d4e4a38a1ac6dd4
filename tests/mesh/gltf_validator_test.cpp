// SPDX-License-Identifier: Apache-2.0
// The Khronos glTF validator as judge of what we write. Needs npm and, once, its registry.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "mesh/furnished_room.hpp"
#include "semview/map/extrusion.hpp"
#include "semview/map/gltf_write.hpp"
#include "support/paths.hpp"

namespace semview::map {
namespace {

// In the build folder, so that it is fetched once.
const std::filesystem::path kFolder =
    std::filesystem::path(SEMVIEW_BINARY_DIR).parent_path() / "gltf_validator";

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool validator_is_there() {
  const auto module = kFolder / "node_modules" / "gltf-validator";
  if (std::filesystem::exists(module)) return true;
  std::filesystem::create_directories(kFolder);
  return run("npm install --no-audit --no-fund --fetch-retries 0 --prefix '" + kFolder.string() +
             "' gltf-validator@2.0.0-dev.3.10 >'" + (kFolder / "npm.log").string() + "' 2>&1") ==
             0 &&
         std::filesystem::exists(module);
}

TEST(GltfValidatorTest, ExportedMapHasNeitherErrorsNorWarnings) {
  if (run("command -v npm >/dev/null && command -v node >/dev/null") != 0) {
    GTEST_SKIP() << "npm or node is not installed: the Khronos validator was not asked";
  }
  if (!validator_is_there()) {
    GTEST_SKIP() << "npm could not fetch gltf-validator (see " << kFolder / "npm.log"
                 << "): the Khronos validator was not asked";
  }
  const SemanticMap map = furnished_room();
  const auto file = kFolder / "room.glb";
  ASSERT_TRUE(write_glb(map, extrude(*map.columns()), file));
  const auto report = kFolder / "report.json";
  const int exit_code =
      run("node '" SEMVIEW_SOURCE_DIR "/tests/mesh/validate_glb.mjs' '" + kFolder.string() + "' '" +
          file.string() + "' >'" + report.string() + "' 2>&1");
  std::ifstream text(report);
  EXPECT_EQ(exit_code, 0) << std::string(std::istreambuf_iterator<char>(text), {});
}

}  // namespace
}  // namespace semview::map
