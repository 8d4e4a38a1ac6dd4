// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/office_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "semview/core/random.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/map/fingerprint.hpp"

namespace semview::benchmark {
namespace {

constexpr ClassId kFloor = 1, kCeiling = 2, kFurniture = 7;
constexpr double kCeiling_m = 2.7;
constexpr double kWall_m = 0.15, kCorridor_m = 2.5, kRoom_m = 5.0;
constexpr double kBand_m = 2.0 * kRoom_m + kCorridor_m;

// Profiles follow the classes that are drawn, as a bundle's do: all but the ceiling.
constexpr std::uint8_t kOutside = 0, kFree = 1, kWall = 2, kDoor = 3, kWindow = 4, kLintel = 5;
constexpr ClassId class_of(std::uint8_t profile) {
  return static_cast<ClassId>(profile == kFree ? kFloor : profile + 1);
}

/// A kind of furniture: what lies between two heights, round or not.
struct Kind {
  const char* name;
  double length_m, width_m;
  double low_m, high_m;
  bool round;
};

constexpr std::array kKinds = {
    Kind{"table", 1.6, 0.8, 0.70, 0.75, false},
    Kind{"chair", 0.45, 0.45, 0.40, 0.85, false},
    Kind{"cabinet", 1.2, 0.4, 0.0, 1.9, false},
    Kind{"plant", 0.5, 0.5, 0.0, 1.35, true},
    Kind{"round_table", 1.1, 1.1, 0.70, 0.74, true},
};

/// What a room holds, as kinds.
constexpr std::array kInventory = {0, 1, 1, 1, 1, 2, 3, 4};

const Kind& kind_of_class(int furniture) {
  return kKinds[static_cast<std::size_t>(furniture) % kKinds.size()];
}

map::MapClass make_class(const std::string& name, double low_m, double high_m) {
  map::MapClass made;
  made.name = name;
  made.min_height_m = low_m;
  made.max_height_m = high_m;
  return made;
}

std::vector<map::MapClass> classes_of(int furniture_classes) {
  std::vector<map::MapClass> classes = {
      make_class("floor", 0.0, 0.0),
      make_class("ceiling", 0.0, 0.0),
      make_class("wall", 0.0, kCeiling_m),
      make_class("door", 0.0, 2.1),
      make_class("window", 0.9, 2.1),
      make_class("lintel", 2.1, kCeiling_m),
  };
  map::MapClass& door = classes[class_of(kDoor) - 1U];
  map::MapClass& window = classes[class_of(kWindow) - 1U];
  door.above = window.above = window.below = "wall";
  door.passable = true;
  for (int i = 0; i < furniture_classes; ++i) {
    const Kind& kind = kind_of_class(i);
    const auto series = static_cast<std::size_t>(i) / kKinds.size();
    classes.push_back(
        make_class(series == 0 ? kind.name : fmt::format("{}_{}", kind.name, series + 1),
                   kind.low_m,
                   kind.high_m));
  }
  // Far apart, also in the blue of the first ones: no two are equal.
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (i + 1 == kCeiling) continue;
    const auto shade = [i](std::size_t step) {
      return static_cast<unsigned char>(40 + i * step % 211);
    };
    classes[i].color = Rgb{shade(67), shade(131), shade(1)};
  }
  return classes;
}

std::vector<ColumnProfile> profiles_of(const std::vector<map::MapClass>& classes) {
  const auto inside = [](std::vector<Slab> slabs) {
    return ColumnProfile{false, false, kFloor, std::move(slabs)};
  };
  std::vector<ColumnProfile> profiles = {{true, false, kNoHit, {}}, inside({})};
  constexpr ClassId wall = class_of(kWall);
  for (std::size_t id = wall; id <= classes.size(); ++id) {
    const map::MapClass& own = classes[id - 1];
    std::vector<Slab> slabs;
    if (!own.below.empty()) slabs.push_back({0.0, own.min_height_m, wall});
    slabs.push_back({own.min_height_m, own.max_height_m, static_cast<ClassId>(id)});
    if (!own.above.empty()) slabs.push_back({own.max_height_m, kCeiling_m, wall});
    profiles.push_back(inside(std::move(slabs)));
    profiles.back().passable = own.passable;
  }
  return profiles;
}

class Draughtsman {
 public:
  Draughtsman(const OfficePlan& plan, Image<std::uint8_t>& pixels)
      : plan_(plan), pixels_(pixels), furniture_classes_(plan.classes - (kFurniture - 1)) {}

  void draw() {
    rectangle(0.0, 0.0, plan_.width_m, plan_.depth_m, kFree);
    for (double v = 0.0; v + kBand_m <= plan_.depth_m + 1e-9; v += kBand_m) band(v);
    outer_walls();
    across();
  }

 private:
  using Corner = std::array<double, 2>;

  int pixel_of(double metres) const {
    return static_cast<int>(std::floor(metres / plan_.resolution_m + 0.5));
  }

  /// Pixels whose corners round into [u0, u1) × [v0, v1).
  void rectangle(double u0, double v0, double u1, double v1, std::uint8_t profile) {
    const int left = std::max(0, pixel_of(u0)), right = std::min(pixels_.columns(), pixel_of(u1));
    const int low = std::max(0, pixel_of(v0)), high = std::min(pixels_.rows(), pixel_of(v1));
    for (int y = low; y < high; ++y) {
      for (int c = left; c < right; ++c) pixels_.at(pixels_.rows() - 1 - y, c) = profile;
    }
  }

  void wall_along(double u0, double u1, double v) {
    rectangle(u0, v - kWall_m / 2.0, u1, v + kWall_m / 2.0, kWall);
  }
  void wall_across(double u, double v0, double v1) {
    rectangle(u - kWall_m / 2.0, v0, u + kWall_m / 2.0, v1, kWall);
  }

  /// Two rows of rooms with a corridor between them.
  void band(double v0) {
    const double corridor_v0 = v0 + kRoom_m, corridor_v1 = corridor_v0 + kCorridor_m;
    if (v0 > 0.0) wall_along(0.0, plan_.width_m, v0);
    wall_along(0.0, plan_.width_m, corridor_v0);
    wall_along(0.0, plan_.width_m, corridor_v1);
    for (double u = 0.0; u + 2.0 < plan_.width_m; u += kRoom_m) {
      const double width = std::min(kRoom_m, plan_.width_m - u);
      room(u, v0, width, corridor_v0);
      room(u, corridor_v1, width, corridor_v1);
    }
  }

  /// A room with its furniture, and its door in the wall at `door_v`.
  void room(double u0, double v0, double width, double door_v) {
    Rng rng(plan_.seed, "room", rooms_++);
    if (u0 > 0.0) wall_across(u0, v0, v0 + kRoom_m);
    const double door_u = u0 + rng.uniform(0.4, width - 1.4);
    const std::uint8_t door = rng.uniform() < 0.5 ? kLintel : kDoor;
    rectangle(door_u, door_v - kWall_m / 2.0, door_u + 0.9, door_v + kWall_m / 2.0, door);
    for (std::size_t i = 0; i < kInventory.size(); ++i) {
      const double u = u0 + rng.uniform(0.5, width - 0.5);
      const double v = v0 + rng.uniform(0.5, kRoom_m - 0.5);
      const auto series = static_cast<int>(rng.below(1000));
      piece(furniture_class(kInventory[i], series), u, v, rng.uniform(-kPi, kPi));
    }
  }

  /// A class of this kind; of another one only where there are too few classes for all kinds.
  int furniture_class(int kind, int series) const {
    const auto kinds = static_cast<int>(kKinds.size());
    if (kind >= furniture_classes_) return kind % furniture_classes_;
    const int of_this_kind = (furniture_classes_ - 1 - kind) / kinds + 1;
    return kind + kinds * (series % of_this_kind);
  }

  void piece(int furniture, double u, double v, double yaw_rad) {
    const Kind& kind = kind_of_class(furniture);
    const auto profile = static_cast<std::uint8_t>(kFurniture - 1 + furniture);
    const double reach = std::hypot(kind.length_m, kind.width_m) / 2.0;
    const double cosine = std::cos(yaw_rad), sine = std::sin(yaw_rad);
    for (int y = pixel_of(v - reach); y <= pixel_of(v + reach); ++y) {
      for (int c = pixel_of(u - reach); c <= pixel_of(u + reach); ++c) {
        const int row = pixels_.rows() - 1 - y;
        if (row < 0 || y < 0 || c < 0 || c >= pixels_.columns()) continue;
        const double du = (c + 0.5) * plan_.resolution_m - u;
        const double dv = (y + 0.5) * plan_.resolution_m - v;
        const double along = cosine * du + sine * dv, aside = cosine * dv - sine * du;
        const bool inside = kind.round ? std::hypot(du, dv) <= kind.length_m / 2.0
                                       : std::abs(along) <= kind.length_m / 2.0 &&
                                             std::abs(aside) <= kind.width_m / 2.0;
        std::uint8_t& pixel = pixels_.at(row, c);
        if (inside && pixel == kFree) pixel = profile;
      }
    }
  }

  void outer_walls() {
    const double w = plan_.width_m, d = plan_.depth_m, t = 2.0 * kWall_m;
    rectangle(0.0, 0.0, w, t, kWall);
    rectangle(0.0, d - t, w, d, kWall);
    rectangle(0.0, 0.0, t, d, kWall);
    rectangle(w - t, 0.0, w, d, kWall);
    for (double u = 0.0; u + 3.5 < w; u += kRoom_m) {
      rectangle(u + 1.5, 0.0, u + 3.5, t, kWindow);
      rectangle(u + 1.5, d - t, u + 3.5, d, kWindow);
    }
  }

  /// The corridor that joins the bands, through whatever stands in the middle.
  void across() {
    const double middle = plan_.width_m / 2.0, half = kCorridor_m / 2.0, t = 2.0 * kWall_m;
    wall_across(middle - half, t, plan_.depth_m - t);
    wall_across(middle + half, t, plan_.depth_m - t);
    rectangle(
        middle - half + kWall_m / 2.0, t, middle + half - kWall_m / 2.0, plan_.depth_m - t, kFree);
    for (double v = kRoom_m; v + kCorridor_m <= plan_.depth_m; v += kBand_m) {
      rectangle(middle - half - kWall_m,
                v + kWall_m,
                middle + half + kWall_m,
                v + kCorridor_m - kWall_m,
                kLintel);
    }
  }

  const OfficePlan& plan_;
  Image<std::uint8_t>& pixels_;
  int furniture_classes_;
  std::uint64_t rooms_ = 0;
};

Status validate(const OfficePlan& plan) {
  const auto refuse = [](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, "generated office: " + what);
  };
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (!within(plan.width_m, 5.0, 2000.0) || !within(plan.depth_m, 5.0, 2000.0)) {
    return refuse(
        fmt::format("{} x {} m: expected sides of 5 to 2000 m", plan.width_m, plan.depth_m));
  }
  if (!within(plan.resolution_m, 0.005, 0.2)) {
    return refuse(fmt::format("{} m a pixel: expected 0.005 to 0.2", plan.resolution_m));
  }
  const double pixels = plan.width_m * plan.depth_m / plan.resolution_m / plan.resolution_m;
  if (pixels > 4e8) return refuse(fmt::format("{:.0f} pixels: expected at most 4e8", pixels));
  if (!within(plan.classes, kFewestOfficeClasses, kMostOfficeClasses)) {
    return refuse(fmt::format(
        "{} classes: expected {} to {}", plan.classes, kFewestOfficeClasses, kMostOfficeClasses));
  }
  return {};
}

}  // namespace

Result<map::SemanticMap> draw_office(const OfficePlan& plan) {
  SEMVIEW_TRY_STATUS(validate(plan));
  map::ColumnMap columns;
  columns.resolution_m = plan.resolution_m;
  columns.ceiling = map::Ceiling{kCeiling, kCeiling_m};
  std::vector<map::MapClass> classes = classes_of(plan.classes - (kFurniture - 1));
  columns.profiles = profiles_of(classes);
  columns.profile_of_pixel =
      Image<std::uint8_t>(static_cast<int>(std::lround(plan.depth_m / plan.resolution_m)),
                          static_cast<int>(std::lround(plan.width_m / plan.resolution_m)),
                          kOutside);
  Draughtsman(plan, columns.profile_of_pixel).draw();

  map::SemanticMap map;
  map.id = fmt::format("office_{:g}x{:g}_{:g}cm",
                       plan.width_m,
                       plan.depth_m,
                       std::round(plan.resolution_m * 1e4) / 100.0);
  map.name = fmt::format("Generated office, {:g} x {:g} m", plan.width_m, plan.depth_m);
  std::vector<std::string> names;
  for (const map::MapClass& own : classes) names.push_back(own.name);
  map.classes = ClassTable(std::move(names));
  map.class_details = std::move(classes);
  map.ground_label = kFloor;
  map.ceiling = columns.ceiling;
  map.geometry = std::move(columns);
  map.fingerprint = map::fingerprint_of(map);
  return map;
}

}  // namespace semview::benchmark
