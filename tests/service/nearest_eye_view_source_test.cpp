// SPDX-License-Identifier: Apache-2.0
#include "semview/service/nearest_eye_view_source.hpp"

#include <gtest/gtest.h>

#include "semview/map/cell_grid.hpp"
#include "support/random_view.hpp"

namespace semview::service {
namespace {

/// Records what it is asked for.
class RecordingSource final : public ViewSource {
 public:
  const ViewProfile& profile() const override { return profile_; }
  Result<ViewBatch> views(std::span<const CellIndex> cells) override {
    asked.assign(cells.begin(), cells.end());
    ViewBatch batch;
    for (const CellIndex& cell : cells) {
      batch.views.push_back(testing::shared_random_view(std::hash<CellIndex>()(cell)));
    }
    batch.origins.cast = cells.size();
    return batch;
  }
  std::vector<CellIndex> asked;

 private:
  ViewProfile profile_;
};

// Eyes at ix 0..3 of one row of twelve.
map::CellGrid corridor() {
  std::vector<std::uint8_t> facts(12, 0);
  for (std::size_t i = 0; i < 4; ++i) facts[i] = map::CellGrid::kFree | map::CellGrid::kHasEye;
  return {{0, 0}, 12, 1, std::move(facts)};
}

TEST(NearestEyeViewSourceTest, AsksForEachViewCellOnceAndLeavesTheRestNull) {
  RecordingSource source;
  const map::CellGrid grid = corridor();
  NearestEyeViewSource views(source, grid);
  // 8 is 0.5 m from 3, 9 is too far.
  const std::vector<CellIndex> cells = {{8, 0}, {1, 0}, {3, 0}, {9, 0}, {5, 0}, {1, 0}};
  const auto batch = views.views(cells);
  ASSERT_TRUE(batch.has_value());
  EXPECT_EQ(source.asked, (std::vector<CellIndex>{{3, 0}, {1, 0}}));
  EXPECT_EQ(batch->views[0], batch->views[2]);
  EXPECT_EQ(batch->views[0], batch->views[4]);
  EXPECT_EQ(batch->views[1], batch->views[5]);
  EXPECT_EQ(batch->views[3], nullptr);
  EXPECT_EQ(batch->origins.total(), 2U);
}

TEST(NearestEyeViewSourceTest, ViewCellsAreDistinctAndInOrder) {
  const map::CellGrid grid = corridor();
  const std::vector<CellIndex> cells = {{8, 0}, {1, 0}, {3, 0}, {11, 0}, {1, 0}};
  EXPECT_EQ(view_cells(grid, cells), (std::vector<CellIndex>{{1, 0}, {3, 0}}));
}

}  // namespace
}  // namespace semview::service
