// SPDX-License-Identifier: Apache-2.0
/// The matrices of identity and of class subsets, made from the hand-made one.
#include <gtest/gtest.h>

#include "experiments/paper2017/hand_matrix.hpp"
#include "experiments/paper2017/raw_classes.hpp"
#include "experiments/paper2017/trial.hpp"

namespace semview::paper2017 {
namespace {

similarity::WeightMatrix small() {
  // Rows: wall, floor, desk; columns: wall, floor, table, none.
  return *similarity::parse_weight_matrix(
      "observed,wall,floor,table,none\n"
      "wall,0.25,-1,0,0\n"
      "floor,-1,0.25,0,0\n"
      "table,0,0,1,0\n"
      "desk,0,0,0.8,0.1\n",
      "small");
}

TEST(RowWeightsTest, IdentityIsOneWhereAColumnsHighestWeightIs) {
  const similarity::WeightMatrix identity = identity_of(small());
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      // wall-wall, floor-floor, table-table; a desk is no table, and nothing matches nothing.
      EXPECT_EQ(identity.weight(0, i, j), i == j && i < 3 ? 1.0 : 0.0) << i << ", " << j;
    }
  }
}

TEST(RowWeightsTest, FurnitureAloneTakesThePlansGroundForNothing) {
  const similarity::WeightMatrix all = row_weights(small(), WeightsKind::kHand, ClassSubset::kAll);
  EXPECT_EQ(all, small());
  const similarity::WeightMatrix furniture =
      row_weights(small(), WeightsKind::kHand, ClassSubset::kFurniture);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(furniture.weight(0, i, 1), 0.0);
    EXPECT_EQ(furniture.weight(0, i, 2), small().weight(0, i, 2));
  }
}

TEST(RowWeightsTest, TheShippedMatrixHasARowForAllThatTheCameraNames) {
  const auto shipped = similarity::parse_weight_matrix(kHandMatrix, "shipped");
  ASSERT_TRUE(shipped) << shipped.error().message;
  const ClassTable map(map_class_names());
  EXPECT_TRUE(shipped->check(raw_classes(), map));
}

}  // namespace
}  // namespace semview::paper2017
