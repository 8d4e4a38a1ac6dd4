// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/engine_choice.hpp"

#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "raycast/small_worlds.hpp"
#include "semview/map/extrusion.hpp"

namespace semview::raycast {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class EngineChoiceTest : public ::testing::Test {
 protected:
  EngineChoiceTest() {
    Rng rng(5, "choice");
    plan_ = random_plan(rng, 13, 17);
    scene_ = std::make_shared<const Scene>(*Scene::build(map::extrude(plan_)));
    cells_ = map::build_cell_grid(plan_, ViewProfile{}.eye_height_m);
  }

  /// Of `plan`, or of the mesh alone if it is null; the mesh is that of `plan_`.
  Result<EngineChoice> choose(std::string_view name, const map::ColumnMap* plan) {
    return choose_engine(name, {"test", classes_, plan, scene_, cells_, 0.0}, {}, pool_);
  }

  const ClassTable classes_{{"floor", "ceiling", "wall", "table", "door", "window", "rug"}};
  map::ColumnMap plan_;
  std::shared_ptr<const Scene> scene_;
  map::CellGrid cells_;
  ThreadPool pool_{2};
};

TEST_F(EngineChoiceTest, APlanIsCastByColumnsOnceEmbreeAgrees) {
  const auto choice = choose("auto", &plan_);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->engine->name(), "columns");
  EXPECT_THAT(choice->reason, HasSubstr("embree sees the same from"));
}

TEST_F(EngineChoiceTest, WithoutAPlaceToCompareFromNoAgreementIsClaimed) {
  map::ColumnMap low = plan_;
  low.ceiling = map::Ceiling{5, 1.0};
  cells_ = map::build_cell_grid(low, ViewProfile{}.eye_height_m);
  const auto choice = choose("auto", &low);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->engine->name(), "columns");
  EXPECT_THAT(choice->reason, Not(HasSubstr("the same")));
}

TEST_F(EngineChoiceTest, AMeshIsCastByEmbree) {
  const auto choice = choose("auto", nullptr);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->engine->name(), "embree");
  EXPECT_EQ(choice->reason, "the map is a mesh");
}

TEST_F(EngineChoiceTest, WhoAsksGetsWhatHeAskedFor) {
  for (const char* name : {"embree", "columns"}) {
    const auto choice = choose(name, &plan_);
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->engine->name(), name);
    EXPECT_EQ(choice->reason, "it was asked for");
  }
}

TEST_F(EngineChoiceTest, ColumnsOfAMeshAreRefused) {
  const auto choice = choose("columns", nullptr);
  ASSERT_FALSE(choice);
  EXPECT_EQ(choice.error().field, "--engine");
  EXPECT_THAT(choice.error().message, HasSubstr("map test: is a mesh"));
}

TEST_F(EngineChoiceTest, AnUnknownNameIsRefusedWithThoseThatAreKnown) {
  const auto choice = choose("crystal", &plan_);
  ASSERT_FALSE(choice);
  EXPECT_EQ(choice.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(choice.error().message, HasSubstr("auto, columns or embree"));
}

TEST_F(EngineChoiceTest, EmbreeStaysWhereTheTwoDisagreeAndSaysWhere) {
  map::ColumnMap other = plan_;
  // Table tops 5 cm higher than in the mesh.
  for (ColumnProfile& profile : other.profiles) {
    for (Slab& slab : profile.slabs) {
      if (slab.label == kPlanTable) slab.z_max_m += 0.05;
    }
  }
  const auto choice = choose("auto", &other);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->engine->name(), "embree");
  EXPECT_THAT(choice->reason, HasSubstr("columns and embree disagree in cell ("));
  EXPECT_THAT(choice->reason, HasSubstr("table"));
}

}  // namespace
}  // namespace semview::raycast
