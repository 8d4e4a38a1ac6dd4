// SPDX-License-Identifier: Apache-2.0
/// No file, however damaged, does more than make the check fail.
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "map/bundle.hpp"
#include "semview/core/random.hpp"
#include "semview/map/map_checker.hpp"

namespace semview::map {
namespace {

using testing::TempFolder;
using testing::write_bundle;
using testing::write_text;

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Every report has an error, or there is a map.
void expect_orderly(const std::filesystem::path& folder) {
  const MapCheck check = check_map(folder);
  EXPECT_TRUE(check.map || check.report.has_errors());
  for (const MapProblem& problem : check.report.problems) EXPECT_FALSE(problem.message.empty());
}

TEST(DamagedBundleTest, FilesCutShort) {
  TempFolder folder;
  write_bundle(folder.path(), testing::room());
  for (const char* name : {"map.yaml", "labels.png"}) {
    const std::string whole = read_bytes(folder / name);
    for (std::size_t size = 0; size < whole.size(); size += 3) {
      write_text(folder / name, whole.substr(0, size));
      expect_orderly(folder.path());
    }
    write_text(folder / name, whole);
  }
}

TEST(DamagedBundleTest, BytesChanged) {
  TempFolder folder;
  write_bundle(folder.path(), testing::room());
  Rng rng(11, "damage");
  for (const char* name : {"map.yaml", "labels.png"}) {
    const std::string whole = read_bytes(folder / name);
    for (int round = 0; round < 300; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 3; ++i) {
        damaged[rng.below(damaged.size())] = static_cast<char>(rng.below(256));
      }
      write_text(folder / name, damaged);
      expect_orderly(folder.path());
    }
    write_text(folder / name, whole);
  }
}

}  // namespace
}  // namespace semview::map
