// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/picture/class_plan_picture.hpp"
#include "semview/picture/colour_map.hpp"
#include "semview/picture/heat_picture.hpp"
#include "semview/picture/track_picture.hpp"
#include "support/temporary_folder.hpp"

namespace semview::picture {
namespace {

using semview::testing::file_bytes;
using semview::testing::TemporaryFolder;

/// The middle of all pixels of a colour, as shares of the picture's size; negative if there is
/// none.
struct Centre {
  double across = -1.0;
  double down = -1.0;
};

Centre centre_of(const RgbImage& image, const Rgb& colour) {
  double rows = 0.0;
  double columns = 0.0;
  int count = 0;
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.columns(); ++c) {
      if (image.at(r, c) != colour) continue;
      rows += r;
      columns += c;
      ++count;
    }
  }
  if (count == 0) return {};
  return {columns / count / image.columns(), rows / count / image.rows()};
}

constexpr Rgb kMark{250, 10, 200};

/// 10 × 10 m; the marked pixel covers x 8 to 9 m, y 1 to 2 m seen from the origin.
Plan marked_plan(const Pose2& origin) {
  Plan plan{RgbImage(10, 10, {240, 240, 240}), 1.0, origin};
  plan.image.at(8, 8) = kMark;
  return plan;
}

TEST(ClassPlanPictureTest, TheLegendListsTheClassesThatOccur) {
  ClassPlanPicture picture{marked_plan({}), {}};
  const int without = draw_class_plan(picture).rows();
  picture.classes = {{kMark, "lamp"}};
  const RgbImage drawn = draw_class_plan(picture);
  const RgbImage absent = draw_class_plan({marked_plan({}), {{{1, 2, 3}, "lamp"}}});
  // The marked pixel, 1 % of the plan, and its square in the legend under it.
  EXPECT_GT(std::ranges::count(drawn.pixels(), kMark), std::ranges::count(absent.pixels(), kMark));
  EXPECT_EQ(absent.rows(), without) << "no line for a class that does not occur";
  EXPECT_EQ(std::ranges::count(absent.pixels(), Rgb{1, 2, 3}), 0);
}

TEST(ClassPlanPictureTest, AScaleBarInWholeMetresStandsUnderThePlan) {
  const RgbImage drawn = draw_class_plan({marked_plan({}), {}});
  // 10 m wide: the bar is 2 m long, a fifth of the plan's width.
  std::ptrdiff_t plan_width = 0;
  int plan_end = 0;
  std::ptrdiff_t bar = 0;
  for (int row = 0; row < drawn.rows(); ++row) {
    const std::ptrdiff_t plan = std::ranges::count(drawn.row(row), Rgb{240, 240, 240});
    if (plan > 0) plan_end = row;
    plan_width = std::max(plan_width, plan);
    // Past the plan's outline and the marks of the metres along it.
    if (plan_end == 0 || row <= plan_end + 10) continue;
    bar = std::max(bar, std::ranges::count(drawn.row(row), Rgb{38, 42, 48}));
  }
  EXPECT_NEAR(static_cast<double>(bar), static_cast<double>(plan_width) / 5.0, 4.0);
}

TEST(TrackPictureTest, ThePlanStandsUprightWithLowYBelow) {
  TrackPicture picture;
  picture.plan = marked_plan({});
  const Centre mark = centre_of(draw_tracks(picture), kMark);
  EXPECT_GT(mark.across, 0.75);
  EXPECT_GT(mark.down, 0.65);
}

TEST(TrackPictureTest, APlanWithAYawIsTurnedCounterClockwise) {
  TrackPicture picture;
  picture.plan = marked_plan({0.0, 0.0, kPi / 2.0});
  // x 8.5, y 1.5 of the plan lies at x -1.5, y 8.5 of the map: upper right of [-10, 0] × [0, 10].
  const Centre mark = centre_of(draw_tracks(picture), kMark);
  EXPECT_GT(mark.across, 0.7);
  EXPECT_GT(mark.down, 0.0);
  EXPECT_LT(mark.down, 0.3);
}

TEST(TrackPictureTest, TracksLieOnThePlanWhereTheirPosesAre) {
  TrackPicture picture;
  picture.plan = Plan{RgbImage(10, 10, {240, 240, 240}), 1.0, {}};
  constexpr Rgb kColour{1, 160, 2};
  picture.tracks = {{"low", kColour, false, {{1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}}}};
  const Centre low = centre_of(draw_tracks(picture), kColour);
  picture.tracks[0].poses = {{1.0, 9.0, 0.0}, {9.0, 9.0, 0.0}};
  const Centre high = centre_of(draw_tracks(picture), kColour);
  EXPECT_GT(low.down, high.down + 0.3);
}

TEST(TrackPictureTest, EmptyTracksAndNoPlanAreNoFault) {
  TrackPicture picture;
  EXPECT_FALSE(draw_tracks(picture).empty());
  picture.tracks = {{"nothing", kTruthColour, false, {}}};
  picture.particles = {{1.0, 1.0, 0.0}};
  EXPECT_FALSE(draw_tracks(picture).empty());
}

TEST(TrackPictureTest, TheSvgIsTheSameDrawing) {
  const TemporaryFolder folder;
  TrackPicture picture;
  picture.plan = marked_plan({});
  picture.tracks = {{"truth", kTruthColour, false, {{1.0, 1.0, 0.0}, {9.0, 1.0, 0.0}}}};
  const RgbImage pixels = draw_tracks(picture);
  ASSERT_TRUE(write_tracks_svg(folder / "a.svg", picture));
  const std::string svg = file_bytes(folder / "a.svg");
  EXPECT_THAT(svg, ::testing::HasSubstr("width=\"" + std::to_string(pixels.columns())));
  EXPECT_THAT(svg, ::testing::HasSubstr("data:image/png;base64"));
  EXPECT_THAT(svg, ::testing::HasSubstr("</svg>"));
  EXPECT_EQ(write_tracks_svg(folder / "no/such/a.svg", picture).error().code,
            ErrorCode::kUnavailable);
}

TEST(HeatPictureTest, RowZeroIsTheLowestYAndNothingIsWhereThereIsNoValue) {
  HeatPicture picture;
  picture.values = Image<float>(50, 50, std::numeric_limits<float>::quiet_NaN());
  picture.x_min_m = -2.0;
  picture.y_min_m = -2.0;
  picture.values.at(0, 0) = 0.0F;
  for (int c = 0; c < 50; ++c) picture.values.at(5, c) = 1.0F;
  RgbImage image = draw_heat_map(picture);
  // The colour bar holds every colour: look at the map alone.
  RgbImage map(image.rows(), image.columns() * 8 / 10);
  for (int r = 0; r < map.rows(); ++r) {
    for (int c = 0; c < map.columns(); ++c) map.at(r, c) = image.at(r, c);
  }
  EXPECT_GT(centre_of(map, viridis(1.0)).down, 0.7);
  EXPECT_LT(centre_of(map, viridis(0.0)).across, 0.2);
  EXPECT_LT(centre_of(map, viridis(0.5)).across, 0.0);
}

TEST(HeatPictureTest, ConstantAndEmptyMapsAreNoFault) {
  HeatPicture picture;
  EXPECT_TRUE(draw_heat_map(picture).empty());
  picture.values = Image<float>(3, 3, 0.25F);
  EXPECT_FALSE(draw_heat_map(picture).empty());
  picture.values = Image<float>(3, 3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(draw_heat_map(picture).empty());
}

}  // namespace
}  // namespace semview::picture
