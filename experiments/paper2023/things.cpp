// SPDX-License-Identifier: Apache-2.0
#include "things.hpp"

namespace semview::paper2023 {
namespace {

using paper2017::Primitive;
using paper2017::Shape;

class Maker {
 public:
  explicit Maker(const Thing& thing) : thing_(thing) {}

  std::vector<Primitive> make() {
    switch (thing_.shape) {
      case ThingClass::kChair:
        chair();
        break;
      case ThingClass::kSofa:
        sofa();
        break;
      case ThingClass::kBed:
        bed();
        break;
      case ThingClass::kTable:
        table();
        break;
      case ThingClass::kTelevision:
        television();
        break;
      case ThingClass::kPlant:
        plant();
        break;
      case ThingClass::kSink:
        sink();
        break;
      case ThingClass::kShelf:
        shelf();
        break;
      case ThingClass::kLamp:
        lamp();
        break;
      case ThingClass::kRefrigerator:
      case ThingClass::kCabinet:
      case ThingClass::kBox:
        box(0.0, 0.0, thing_.length_m, thing_.width_m, 0.0, thing_.height_m);
        break;
    }
    return std::move(solids_);
  }

 private:
  void add(Shape shape,
           double x_m,
           double y_m,
           double half_length_m,
           double half_width_m,
           double z_min_m,
           double z_max_m) {
    const Pose2 pose = thing_.map_from_thing * Pose2{x_m, y_m, 0.0};
    solids_.push_back({shape,
                       thing_.named ? static_cast<ClassId>(thing_.name) : kNoHit,
                       thing_.id,
                       pose.x_m,
                       pose.y_m,
                       pose.yaw_rad,
                       half_length_m,
                       half_width_m,
                       z_min_m,
                       z_max_m});
  }

  void box(
      double x_m, double y_m, double length_m, double width_m, double z_min_m, double z_max_m) {
    add(Shape::kBox, x_m, y_m, length_m / 2.0, width_m / 2.0, z_min_m, z_max_m);
  }

  void cylinder(double radius_m, double z_min_m, double z_max_m) {
    add(Shape::kCylinder, 0.0, 0.0, radius_m, radius_m, z_min_m, z_max_m);
  }

  void legs(double side_m, double z_max_m) {
    const double x_m = (thing_.length_m - side_m) / 2.0;
    const double y_m = (thing_.width_m - side_m) / 2.0;
    for (const double x : {-x_m, x_m}) {
      for (const double y : {-y_m, y_m}) box(x, y, side_m, side_m, 0.0, z_max_m);
    }
  }

  void chair() {
    constexpr double kSeat_m = 0.46;
    legs(0.04, kSeat_m - 0.05);
    box(0.0, 0.0, thing_.length_m, thing_.width_m, kSeat_m - 0.05, kSeat_m);
    box(0.0, -(thing_.width_m - 0.05) / 2.0, thing_.length_m, 0.05, kSeat_m, thing_.height_m);
  }

  void sofa() {
    constexpr double kSeat_m = 0.42;
    constexpr double kBack_m = 0.20;
    const double arm_x_m = (thing_.length_m - kBack_m) / 2.0;
    box(0.0, 0.0, thing_.length_m, thing_.width_m, 0.05, kSeat_m);
    box(0.0, -(thing_.width_m - kBack_m) / 2.0, thing_.length_m, kBack_m, kSeat_m, thing_.height_m);
    for (const double x : {-arm_x_m, arm_x_m}) {
      box(x, 0.0, kBack_m, thing_.width_m, kSeat_m, kSeat_m + 0.18);
    }
  }

  void bed() {
    constexpr double kMattress_m = 0.5;
    box(0.0, 0.0, thing_.length_m, thing_.width_m, 0.1, kMattress_m);
    box(0.0, -(thing_.width_m - 0.06) / 2.0, thing_.length_m, 0.06, kMattress_m, thing_.height_m);
  }

  void table() {
    legs(0.05, thing_.height_m - 0.04);
    box(0.0, 0.0, thing_.length_m, thing_.width_m, thing_.height_m - 0.04, thing_.height_m);
  }

  void television() {
    box(0.0, 0.0, 0.5, thing_.width_m, 0.0, 0.03);
    cylinder(0.04, 0.03, 0.7);
    box(0.0, 0.0, thing_.length_m, 0.07, 0.7, thing_.height_m);
  }

  void plant() {
    cylinder(thing_.length_m * 0.3, 0.0, 0.3);
    cylinder(thing_.length_m / 2.0, 0.3, thing_.height_m);
  }

  void sink() {
    box(0.0, 0.0, thing_.length_m * 0.9, thing_.width_m * 0.9, 0.0, thing_.height_m - 0.18);
    box(0.0, 0.0, thing_.length_m, thing_.width_m, thing_.height_m - 0.18, thing_.height_m);
  }

  void shelf() {
    constexpr double kBoard_m = 0.03;
    constexpr int kBoards = 5;
    const double side_x_m = (thing_.length_m - kBoard_m) / 2.0;
    box(0.0, -(thing_.width_m - kBoard_m) / 2.0, thing_.length_m, kBoard_m, 0.0, thing_.height_m);
    for (const double x : {-side_x_m, side_x_m}) {
      box(x, 0.0, kBoard_m, thing_.width_m, 0.0, thing_.height_m);
    }
    for (int board = 0; board < kBoards; ++board) {
      const double z_m = (thing_.height_m - kBoard_m) * board / (kBoards - 1);
      box(0.0, 0.0, thing_.length_m, thing_.width_m, z_m, z_m + kBoard_m);
    }
  }

  void lamp() {
    cylinder(0.15, 0.0, 0.03);
    cylinder(0.02, 0.03, thing_.height_m - 0.3);
    cylinder(thing_.length_m / 2.0, thing_.height_m - 0.3, thing_.height_m);
  }

  const Thing& thing_;
  std::vector<Primitive> solids_;
};

}  // namespace

const ClassTable& thing_classes() {
  static const ClassTable kClasses({"chair",
                                    "sofa",
                                    "bed",
                                    "table",
                                    "television",
                                    "plant",
                                    "refrigerator",
                                    "sink",
                                    "cabinet",
                                    "shelf",
                                    "lamp",
                                    "box"});
  return kClasses;
}

std::vector<Primitive> solids_of(const Thing& thing) { return Maker(thing).make(); }

}  // namespace semview::paper2023
