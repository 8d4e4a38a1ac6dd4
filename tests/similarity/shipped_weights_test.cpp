// SPDX-License-Identifier: Apache-2.0
/// Every shipped map has a matrix that covers it and the ADE20K vocabulary.
#include <filesystem>

#include <gtest/gtest.h>

#include "semview/map/semantic_map.hpp"
#include "semview/similarity/vocabulary.hpp"
#include "semview/similarity/weight_proposal.hpp"
#include "support/paths.hpp"

namespace semview::similarity {
namespace {

TEST(ShippedMapWeightsTest, CoverTheirMapAndTheVocabulary) {
  const Vocabulary ade = shipped_vocabulary("ade20k150").value();
  int maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SEMVIEW_SOURCE_DIR "/maps")) {
    if (!exists(entry.path() / "map.yaml")) continue;
    ++maps;
    const auto map = map::load_map(entry.path());
    ASSERT_TRUE(map) << map.error().message;
    const auto weights = read_weight_matrix(entry.path() / "weights.csv");
    ASSERT_TRUE(weights) << weights.error().message;
    const Status status = weights->check(class_table(ade), map->classes);
    EXPECT_TRUE(status) << entry.path() << ": " << status.error().message;

    Vocabulary classes;
    for (const map::MapClass& details : map->class_details) {
      classes.push_back({details.name, details.aliases});
    }
    const auto proposal = propose_weights(ade, classes);
    ASSERT_TRUE(proposal);
    EXPECT_TRUE(proposal->unmatched_map.empty())
        << entry.path() << ": " << proposal->unmatched_map.front();
    EXPECT_EQ(proposal->matrix, *weights)
        << entry.path() << ": run `semview weights init` for it again";
  }
  EXPECT_GE(maps, 3);
}

}  // namespace
}  // namespace semview::similarity
