// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/mesh_cell_grid.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/map/map_limits.hpp"
#include "semview/raycast/ray_caster.hpp"

namespace semview::raycast {
namespace {

constexpr double kStep_m = 0.05;  // what a wheel rolls over
constexpr RayDirection kDown{0.0F, 0.0F, -1.0F};
constexpr RayDirection kEast{1.0F, 0.0F, 0.0F};
constexpr RayDirection kNorth{0.0F, 1.0F, 0.0F};
constexpr std::array<RayDirection, 5> kOthers{
    kEast, kNorth, {-1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};

class Prober {
 public:
  Prober(const Scene& scene, double ground_height_m, double eye_height_m)
      : scene_(scene), ground_height_m_(ground_height_m), eye_height_m_(eye_height_m) {}

  std::uint8_t facts(const CellIndex& cell) const {
    const RayCaster eye = caster(cell, eye_height_m_);
    const RayHit below = eye.cast(kDown);
    if (below.label == kNoHit || is_in_solid(eye, below)) return 0;
    unsigned facts = map::CellGrid::kHasEye;
    if (std::abs(eye_height_m_ - static_cast<double>(below.parameter)) <= kStep_m) {
      facts |= map::CellGrid::kFree;
      if (is_open(cell, kEast)) facts |= map::CellGrid::kEastOpen;
      if (is_open(cell, kNorth)) facts |= map::CellGrid::kNorthOpen;
    }
    return static_cast<std::uint8_t>(facts);
  }

 private:
  /// By majority, since furniture and walls often stand face on face on floors and on each other:
  /// which of two such faces a ray meets is a matter of luck.
  static bool is_in_solid(const RayCaster& eye, const RayHit& below) {
    int back_faces = below.back_face ? 1 : -1;
    for (const RayDirection& direction : kOthers) {
      const RayHit hit = eye.cast(direction);
      if (hit.label != kNoHit) back_faces += hit.back_face ? 1 : -1;
    }
    return back_faces > 0;
  }

  RayCaster caster(const CellIndex& cell, double height_m) const {
    const Pose2 center = PoseGrid::center(cell);
    return {scene_,
            static_cast<float>(center.x_m),
            static_cast<float>(center.y_m),
            static_cast<float>(ground_height_m_ + height_m)};
  }

  /// Whether the way to the next cell's centre is clear at four heights between step and eye.
  bool is_open(const CellIndex& cell, const RayDirection& direction) const {
    constexpr std::array<double, 4> kParts{0.02, 0.3, 0.65, 1.0};
    for (const double part : kParts) {
      const double height_m = kStep_m + part * (eye_height_m_ - kStep_m);
      const RayHit hit = caster(cell, height_m).cast(direction);
      if (static_cast<double>(hit.parameter) < PoseGrid::kCellSize_m) return false;
    }
    return true;
  }

  const Scene& scene_;
  double ground_height_m_;
  double eye_height_m_;
};

}  // namespace

Result<map::CellGrid> build_cell_grid(const Scene& scene,
                                      double ground_height_m,
                                      double eye_height_m) {
  const Eigen::Vector3d low = scene.bounds().min.cast<double>();
  const Eigen::Vector3d high = scene.bounds().max.cast<double>();
  const auto first = PoseGrid::cell(low.x(), low.y());
  const auto last = PoseGrid::cell(high.x(), high.y());
  if (!first || !last) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("mesh reaches beyond {:g} m from the origin of frame map",
                            PoseGrid::kMaxCoordinate_m));
  }
  const int columns = last->ix - first->ix + 1;
  const int rows = last->iy - first->iy + 1;
  const std::size_t count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (count > map::kMaxGridCells) {
    return fail(ErrorCode::kResourceExhausted,
                fmt::format("mesh covers {} x {} cells of 0.1 m, more than {} in all",
                            columns,
                            rows,
                            map::kMaxGridCells));
  }
  const DenormalsOff denormals_off;
  const Prober prober(scene, ground_height_m, eye_height_m);
  std::vector<std::uint8_t> facts;
  facts.reserve(count);
  for (std::int32_t iy = first->iy; iy <= last->iy; ++iy) {
    for (std::int32_t ix = first->ix; ix <= last->ix; ++ix) facts.push_back(prober.facts({ix, iy}));
  }
  return map::CellGrid(*first, columns, rows, std::move(facts));
}

}  // namespace semview::raycast
