// SPDX-License-Identifier: Apache-2.0
#include "semview/semantics/class_table.hpp"

#include <gtest/gtest.h>

namespace semview {
namespace {

TEST(ClassTableTest, IdsCountFromOneInOrder) {
  const ClassTable table({"wall", "floor", "door"});
  EXPECT_EQ(table.size(), 3);
  EXPECT_EQ(table.id("wall"), ClassId{1});
  EXPECT_EQ(table.id("door"), ClassId{3});
  EXPECT_EQ(table.name(2), "floor");
}

TEST(ClassTableTest, ReservedIdsHaveNamesOfTheirOwn) {
  const ClassTable table({"wall"});
  EXPECT_EQ(table.name(kNoHit), "none");
  EXPECT_EQ(table.name(kUnknown), "unknown");
  EXPECT_EQ(table.name(2), "unknown");
}

TEST(ClassTableTest, NamesThatAreNotThereHaveNoId) {
  EXPECT_FALSE(ClassTable({"wall"}).id("Wall"));
  EXPECT_FALSE(ClassTable().id("wall"));
}

TEST(ClassTableTest, TheLargestTableLeavesTheUnknownIdFree) {
  std::vector<std::string> names;
  for (int i = 1; i <= kMaxClasses; ++i) names.push_back("class " + std::to_string(i));
  const ClassTable table(names);
  EXPECT_EQ(table.id("class 254"), ClassId{254});
  EXPECT_EQ(table.name(254), "class 254");
  EXPECT_EQ(table.name(255), "unknown");
}

}  // namespace
}  // namespace semview
