// SPDX-License-Identifier: Apache-2.0
#include "sketch_picture.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "plan_drawing.hpp"
#include "semview/io/png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/sheet_picture.hpp"
#include "semview/picture/track_picture.hpp"

namespace semview::paper2017 {
namespace {

constexpr double kPixel_m = 0.04;
constexpr double kLine_px = 1.2;
constexpr double kDisc_px = 5.5;
constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kFloor{250, 247, 240};

/// A drawn plan and what is painted on it, in metres of frame `map`.
class Paper {
 public:
  static Result<Paper> of(const std::filesystem::path& bundle) {
    SEMVIEW_TRY(const map::SemanticMap map, map::load_map(bundle));
    SEMVIEW_TRY(const RgbImage drawn, io::read_png_rgb(map.drawing));
    return Paper(drawn, *map.columns(), floor_of(map));
  }

  void line(const Pose2& from, const Pose2& to, Rgb colour, double radius_px = kLine_px) {
    const int steps = 1 + static_cast<int>(2.0 * distance_m(from, to) / kPixel_m);
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      disc({from.x_m + part * (to.x_m - from.x_m), from.y_m + part * (to.y_m - from.y_m), 0.0},
           colour,
           radius_px);
    }
  }

  void disc(const Pose2& at, Rgb colour, double radius_px) {
    const double u = (at.x_m - origin_.x_m) / kPixel_m;
    const double v = image_.rows() - (at.y_m - origin_.y_m) / kPixel_m;
    for (int row = static_cast<int>(v - radius_px); row <= static_cast<int>(v + radius_px); ++row) {
      for (int column = static_cast<int>(u - radius_px); column <= static_cast<int>(u + radius_px);
           ++column) {
        if (row < 0 || row >= image_.rows() || column < 0 || column >= image_.columns()) continue;
        if (std::hypot(column + 0.5 - u, row + 0.5 - v) > radius_px) continue;
        image_.at(row, column) = colour;
      }
    }
  }

  const RgbImage& image() const { return image_; }

 private:
  static Rgb floor_of(const map::SemanticMap& map) {
    return map.class_details[map.ground_label - 1U].color.value_or(kPaper);
  }

  /// In pale colours, floor and outside nearly and wholly white.
  Paper(const RgbImage& drawn, const map::ColumnMap& columns, Rgb floor)
      : image_(pixels(drawn.rows(), columns), pixels(drawn.columns(), columns), kPaper),
        origin_(columns.origin) {
    const double step = kPixel_m / columns.resolution_m;
    for (int row = 0; row < image_.rows(); ++row) {
      for (int column = 0; column < image_.columns(); ++column) {
        const auto v = std::min(drawn.rows() - 1, static_cast<int>((row + 0.5) * step));
        const auto u = std::min(drawn.columns() - 1, static_cast<int>((column + 0.5) * step));
        const Rgb colour = drawn.at(v, u);
        if (colour == Rgb{0, 0, 0}) continue;
        if (colour == floor) {
          image_.at(row, column) = kFloor;
          continue;
        }
        image_.at(row, column) = {pale(colour.r), pale(colour.g), pale(colour.b)};
      }
    }
  }

  static int pixels(int drawn, const map::ColumnMap& columns) {
    return static_cast<int>(drawn * columns.resolution_m / kPixel_m);
  }

  static std::uint8_t pale(std::uint8_t value) {
    return static_cast<std::uint8_t>(128 + value / 2);
  }

  RgbImage image_;
  Pose2 origin_;
};

/// Both plans are in metres of their own: one bar measures both.
RgbImage sheet_of(const SketchDrive& drive, const RgbImage& building, const RgbImage& sketch) {
  picture::SheetPicture sheet;
  sheet.title = fmt::format("World {}: a drive localized on sketch {} by method {}, {} start",
                            drive.world,
                            drive.sketch,
                            drive.method,
                            drive.start == Start::kLocal ? "known" : "unknown");
  sheet.panels = {{"the building, with the robot's way and stops", building},
                  {"the sketch, with the same way and the estimates", sketch}};
  sheet.marks = {{picture::kTruthColour, "where the robot was"},
                 {picture::kEstimateColour, "estimate in the right room"},
                 {picture::kOdometryColour, "estimate in another room"}};
  sheet.pixels_per_m = 1.0 / kPixel_m;
  return draw_sheet(sheet);
}

}  // namespace

Result<RgbImage> draw_sketch_drive(const SketchSettings& settings, const SketchDrive& drive) {
  const World world = make_world(settings.world, WorldSeeds::all(drive.world));
  const Sketch sketch = sketch_of(settings, world, drive.world, drive.sketch);
  const std::filesystem::path plans = settings.out / "pictures";
  const std::filesystem::path truth_plan = plans / fmt::format("world_{}", drive.world);
  const std::filesystem::path sketch_plan =
      plans / fmt::format("world_{}_sketch_{}", drive.world, drive.sketch);
  SEMVIEW_TRY_STATUS(draw_plan(world.layout, {}, drive.world, truth_plan));
  SEMVIEW_TRY_STATUS(draw_plan(sketch.drawn, {}, drive.world, sketch_plan));
  SEMVIEW_TRY(Paper left, Paper::of(truth_plan));
  SEMVIEW_TRY(Paper right, Paper::of(sketch_plan));
  for (std::size_t i = 0; i < drive.stops.size(); ++i) {
    const std::size_t next = std::min(i + 1, drive.stops.size() - 1);
    const Pose2& here = world.stops[i].map_from_robot;
    left.line(here, world.stops[next].map_from_robot, picture::kTruthColour);
    left.disc(here, picture::kTruthColour, kDisc_px);
    right.line(drive.stops[i].true_place, drive.stops[next].true_place, picture::kTruthColour);
  }
  for (const SketchStop& stop : drive.stops) {
    const Rgb colour =
        stop.found_room == stop.true_room ? picture::kEstimateColour : picture::kOdometryColour;
    right.line(stop.true_place, stop.estimate, colour);
    right.disc(stop.estimate, colour, kDisc_px);
  }
  return sheet_of(drive, left.image(), right.image());
}

}  // namespace semview::paper2017
