// SPDX-License-Identifier: Apache-2.0
#include "scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "raw_classes.hpp"
#include "semview/geometry/angle.hpp"

namespace semview::paper2017 {
namespace {

constexpr std::int32_t kStructure = 0;

class Builder {
 public:
  explicit Builder(const Layout& layout) : layout_(layout) {}

  std::vector<Primitive> build() {
    floor_and_ceiling();
    for (std::size_t i = 0; i < layout_.walls.size(); ++i) wall(i);
    for (const Furniture& piece : layout_.furniture) {
      if (!piece.in_world) continue;
      ++object_;
      furniture(piece);
    }
    for (const Clutter& thing : layout_.clutter) {
      ++object_;
      clutter(thing);
    }
    return std::move(solids_);
  }

 private:
  void box(RawClass label,
           const Pose2& pose,
           double length_m,
           double width_m,
           double z_min_m,
           double z_max_m) {
    solids_.push_back({Shape::kBox,
                       static_cast<ClassId>(label),
                       object_,
                       pose.x_m,
                       pose.y_m,
                       pose.yaw_rad,
                       length_m / 2.0,
                       width_m / 2.0,
                       z_min_m,
                       z_max_m});
  }

  void cylinder(
      RawClass label, const Pose2& pose, double radius_m, double z_min_m, double z_max_m) {
    solids_.push_back({Shape::kCylinder,
                       static_cast<ClassId>(label),
                       object_,
                       pose.x_m,
                       pose.y_m,
                       0.0,
                       radius_m,
                       radius_m,
                       z_min_m,
                       z_max_m});
  }

  void floor_and_ceiling() {
    object_ = kStructure;
    const Pose2 middle{layout_.width_m / 2.0, layout_.depth_m / 2.0, 0.0};
    const double length_m = layout_.width_m + 1.0;
    const double width_m = layout_.depth_m + 1.0;
    box(RawClass::kFloor, middle, length_m, width_m, -0.2, 0.0);
    box(RawClass::kCeiling, middle, length_m, width_m, layout_.ceiling_m, layout_.ceiling_m + 0.2);
  }

  static Pose2 on_wall(const Wall& wall, double along_m, double across_m = 0.0) {
    return wall.along_x ? Pose2{along_m, wall.at_m + across_m, 0.0}
                        : Pose2{wall.at_m - across_m, along_m, kPi / 2.0};
  }

  void wall_part(const Wall& wall, double from_m, double to_m, double z_min_m, double z_max_m) {
    if (to_m - from_m < 1e-6 || z_max_m - z_min_m < 1e-6) return;
    const std::int32_t before = std::exchange(object_, kStructure);
    box(RawClass::kWall,
        on_wall(wall, (from_m + to_m) / 2.0),
        to_m - from_m,
        wall.thickness_m,
        z_min_m,
        z_max_m);
    object_ = before;
  }

  void wall(std::size_t index) {
    const Wall& own = layout_.walls[index];
    std::vector<Opening> openings;
    for (const Opening& opening : layout_.openings) {
      if (opening.wall == index) openings.push_back(opening);
    }
    std::ranges::sort(openings, {}, &Opening::from_m);
    double from_m = own.from_m;
    for (const Opening& opening : openings) {
      wall_part(own, from_m, opening.from_m, 0.0, layout_.ceiling_m);
      wall_part(own, opening.from_m, opening.to_m, 0.0, opening.z_min_m);
      wall_part(own, opening.from_m, opening.to_m, opening.z_max_m, layout_.ceiling_m);
      ++object_;
      if (opening.kind == OpeningKind::kDoor) {
        door(own, opening);
      } else {
        window(own, opening);
      }
      from_m = opening.to_m;
    }
    wall_part(own, from_m, own.to_m, 0.0, layout_.ceiling_m);
  }

  void door(const Wall& wall, const Opening& opening) {
    constexpr double kFrame_m = 0.05;
    constexpr double kLeaf_m = 0.04;
    for (const double at_m : {opening.from_m + kFrame_m / 2.0, opening.to_m - kFrame_m / 2.0}) {
      box(RawClass::kDoor,
          on_wall(wall, at_m),
          kFrame_m,
          wall.thickness_m + 0.02,
          0.0,
          opening.z_max_m);
    }
    const double length_m = opening.to_m - opening.from_m - 2.0 * kFrame_m;
    const Pose2 hinge = on_wall(wall, opening.from_m + kFrame_m, opening.side * 0.02);
    const Pose2 hinge_from_leaf =
        Pose2{0.0, 0.0, opening.side * opening.leaf_angle_rad} * Pose2{length_m / 2.0, 0.0, 0.0};
    box(RawClass::kDoor, hinge * hinge_from_leaf, length_m, kLeaf_m, 0.01, opening.z_max_m - 0.02);
  }

  void window(const Wall& wall, const Opening& opening) {
    constexpr double kFrame_m = 0.06;
    const double middle_m = (opening.from_m + opening.to_m) / 2.0;
    const double length_m = opening.to_m - opening.from_m;
    box(RawClass::kWindowpane,
        on_wall(wall, middle_m),
        length_m,
        0.03,
        opening.z_min_m,
        opening.z_max_m);
    for (const double at_m :
         {opening.from_m + kFrame_m / 2.0, middle_m, opening.to_m - kFrame_m / 2.0}) {
      box(RawClass::kWindowpane,
          on_wall(wall, at_m),
          kFrame_m,
          0.08,
          opening.z_min_m,
          opening.z_max_m);
    }
  }

  void slab_on_legs(RawClass label, const Furniture& piece) {
    constexpr double kTop_m = 0.03;
    constexpr double kLeg_m = 0.05;
    box(label, piece.pose, piece.length_m, piece.width_m, piece.height_m - kTop_m, piece.height_m);
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Pose2 corner{
            x * (piece.length_m / 2.0 - kLeg_m), y * (piece.width_m / 2.0 - kLeg_m), 0.0};
        box(label, piece.pose * corner, kLeg_m, kLeg_m, 0.0, piece.height_m - kTop_m);
      }
    }
  }

  void chair(RawClass label, const Furniture& piece, double seat_m) {
    box(label, piece.pose, piece.length_m * 0.9, piece.width_m * 0.9, seat_m - 0.06, seat_m);
    const Pose2 back{-piece.length_m * 0.42, 0.0, 0.0};
    box(label, piece.pose * back, 0.05, piece.width_m * 0.85, seat_m, piece.height_m);
    if (label == RawClass::kSwivelChair) {
      cylinder(label, piece.pose, 0.03, 0.08, seat_m - 0.06);
      cylinder(label, piece.pose, piece.length_m * 0.45, 0.02, 0.08);
      return;
    }
    for (const double x : {-0.4, 0.4}) {
      for (const double y : {-0.4, 0.4}) {
        const Pose2 leg{x * piece.length_m, y * piece.width_m, 0.0};
        box(label, piece.pose * leg, 0.03, 0.03, 0.0, seat_m - 0.06);
      }
    }
  }

  void solid(RawClass label, const Furniture& piece) {
    box(label, piece.pose, piece.length_m, piece.width_m, 0.0, piece.height_m);
  }

  void furniture(const Furniture& piece) {
    const bool one_of_three = piece.variant % 3 == 0;
    switch (piece.kind) {
      case FurnitureKind::kDesk:
        return slab_on_legs(one_of_three ? RawClass::kTable : RawClass::kDesk, piece);
      case FurnitureKind::kTable:
        return slab_on_legs(RawClass::kTable, piece);
      case FurnitureKind::kChair:
        return chair(RawClass::kChair, piece, 0.46);
      case FurnitureKind::kSwivelChair:
        return chair(RawClass::kSwivelChair, piece, 0.50);
      case FurnitureKind::kCupboard:
        return solid(one_of_three ? RawClass::kShelf : RawClass::kCabinet, piece);
      case FurnitureKind::kSideboard:
        return solid(one_of_three ? RawClass::kCabinet : RawClass::kChestOfDrawers, piece);
      case FurnitureKind::kDividingWall:
        return solid(RawClass::kWall, piece);
      case FurnitureKind::kSink: {
        box(RawClass::kSink,
            piece.pose,
            piece.length_m,
            piece.width_m,
            piece.height_m - 0.2,
            piece.height_m);
        box(RawClass::kCabinet,
            piece.pose,
            piece.length_m * 0.9,
            piece.width_m * 0.9,
            0.0,
            piece.height_m - 0.2);
        return;
      }
    }
  }

  void clutter(const Clutter& thing) {
    const auto solid_of = [&](RawClass label) {
      box(label, thing.pose, thing.length_m, thing.width_m, thing.z_min_m, thing.z_max_m);
    };
    switch (thing.kind) {
      case ClutterKind::kBox:
        return solid_of(RawClass::kBox);
      case ClutterKind::kPainting:
        return solid_of(RawClass::kPainting);
      case ClutterKind::kPoster:
        return solid_of(RawClass::kPoster);
      case ClutterKind::kLight:
        return solid_of(RawClass::kLight);
      case ClutterKind::kRadiator:
        return solid_of(RawClass::kRadiator);
      case ClutterKind::kCurtain:
        return solid_of(RawClass::kCurtain);
      case ClutterKind::kMonitor: {
        solid_of(RawClass::kMonitor);
        cylinder(RawClass::kMonitor, thing.pose, 0.06, thing.z_min_m - 0.08, thing.z_min_m);
        return;
      }
      case ClutterKind::kPlant: {
        cylinder(RawClass::kPlant, thing.pose, 0.15, thing.z_min_m, thing.z_min_m + 0.25);
        cylinder(RawClass::kPlant,
                 thing.pose,
                 thing.length_m / 2.0,
                 thing.z_min_m + 0.25,
                 thing.z_max_m);
        return;
      }
    }
  }

  const Layout& layout_;
  std::vector<Primitive> solids_;
  std::int32_t object_ = 0;
};

}  // namespace

Scene build_scene(const Layout& layout) { return Scene(Builder(layout).build()); }

std::vector<Primitive> person(double x_m, double y_m, double height_m, std::int32_t object) {
  const auto part = [&](double radius_m, double z_min_m, double z_max_m) {
    return Primitive{Shape::kCylinder,
                     static_cast<ClassId>(RawClass::kPerson),
                     object,
                     x_m,
                     y_m,
                     0.0,
                     radius_m,
                     radius_m,
                     z_min_m,
                     z_max_m};
  };
  return {part(0.16, 0.0, height_m * 0.5),
          part(0.24, height_m * 0.5, height_m * 0.84),
          part(0.11, height_m * 0.84, height_m)};
}

}  // namespace semview::paper2017
