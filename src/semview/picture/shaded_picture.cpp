// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/shaded_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <Eigen/Geometry>

#include "semview/core/check.hpp"
#include "semview/picture/class_palette.hpp"

namespace semview::picture {
namespace {

struct Material {
  std::string_view name;
  Rgb colour;
};
constexpr Rgb kSky{176, 208, 242};
constexpr std::array kMaterials{
    Material{"wall", {226, 219, 206}},         Material{"floor", {150, 110, 72}},
    Material{"ceiling", {246, 245, 241}},      Material{"door", {128, 84, 50}},
    Material{"window", {205, 228, 250}},       Material{"windowpane", {205, 228, 250}},
    Material{"stairs", {166, 132, 98}},        Material{"stairway", {166, 132, 98}},
    Material{"railing", {72, 72, 76}},         Material{"table", {122, 78, 44}},
    Material{"desk", {122, 78, 44}},           Material{"chair", {58, 58, 66}},
    Material{"sofa", {96, 104, 122}},          Material{"bed", {214, 216, 226}},
    Material{"cabinet", {176, 134, 92}},       Material{"cupboard", {176, 134, 92}},
    Material{"countertop", {92, 92, 96}},      Material{"toilet", {248, 248, 248}},
    Material{"sink", {240, 242, 244}},         Material{"bathtub", {246, 247, 248}},
    Material{"refrigerator", {212, 214, 218}}, Material{"column", {206, 202, 194}}};

Rgb material_of(const ClassTable& classes, ClassId label) {
  if (label == kNoHit) return kSky;
  const auto* known = std::ranges::find(kMaterials, classes.name(label), &Material::name);
  return known != kMaterials.end() ? known->colour : ClassPalette::for_classes(classes)[label];
}

/// A number in [-1, 1) that looks random, of a point to the centimetre.
double grain(const Eigen::Vector3d& point) {
  std::uint32_t hash = 2166136261U;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int32_t>(std::floor(point[axis] * 100.0));
    hash = (hash ^ static_cast<std::uint32_t>(cell)) * 16777619U;
    hash ^= hash >> 13U;
  }
  return static_cast<double>(hash & 0xffffU) / 32768.0 - 1.0;
}

/// The light on a surface of this normal: most on what faces up, some from one side.
double light_on(const Eigen::Vector3d& normal) {
  static const Eigen::Vector3d kLamp = Eigen::Vector3d(0.4, 0.3, 0.866).normalized();
  return 0.72 + 0.2 * std::abs(normal.dot(kLamp)) + 0.08 * std::abs(normal.x());
}

class Shader {
 public:
  Shader(const LabelImage& labels, const RangeImage& distances_m, const RayOfPixel& ray)
      : labels_(labels),
        points_(labels.rows(), labels.columns(), Eigen::Vector3d(Eigen::Vector3d::Zero())) {
    for (int r = 0; r < labels.rows(); ++r) {
      for (int c = 0; c < labels.columns(); ++c) {
        const double distance = distances_m.at(r, c);
        if (std::isfinite(distance)) points_.at(r, c) = ray(r, c) * distance;
      }
    }
  }

  Rgb shade(int r, int c, const Rgb& material) const {
    if (labels_.at(r, c) == kNoHit) return material;
    const Eigen::Vector3d along = step(r, c, 0, 1);
    const Eigen::Vector3d across = step(r, c, 1, 0);
    Eigen::Vector3d normal = along.cross(across);
    normal = normal.norm() > 0.0 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d::UnitZ();
    const double light = light_on(normal) * (1.0 + 0.015 * grain(points_.at(r, c)));
    const auto lit = [light](unsigned char part) {
      return static_cast<unsigned char>(std::lround(std::clamp(part * light, 0.0, 255.0)));
    };
    return {lit(material.r), lit(material.g), lit(material.b)};
  }

 private:
  /// From the pixel before to the one after, as far as they show the same class.
  Eigen::Vector3d step(int r, int c, int rows, int columns) const {
    const auto neighbour = [&](int sign) {
      const int row = std::clamp(r + sign * rows, 0, labels_.rows() - 1);
      const int column = std::clamp(c + sign * columns, 0, labels_.columns() - 1);
      const bool same = labels_.at(row, column) == labels_.at(r, c);
      return same ? points_.at(row, column) : points_.at(r, c);
    };
    return neighbour(1) - neighbour(-1);
  }

  const LabelImage& labels_;
  Image<Eigen::Vector3d> points_;
};

}  // namespace

RgbImage draw_shaded(const LabelImage& labels,
                     const RangeImage& distances_m,
                     const ClassTable& classes,
                     const RayOfPixel& ray) {
  SEMVIEW_CHECK(labels.rows() == distances_m.rows() && labels.columns() == distances_m.columns());
  std::array<Rgb, 256> materials{};
  for (int id = 0; id <= classes.size(); ++id) {
    materials[static_cast<std::size_t>(id)] = material_of(classes, static_cast<ClassId>(id));
  }
  const Shader shader(labels, distances_m, ray);
  RgbImage picture(labels.rows(), labels.columns());
  for (int r = 0; r < picture.rows(); ++r) {
    for (int c = 0; c < picture.columns(); ++c) {
      picture.at(r, c) = shader.shade(r, c, materials[labels.at(r, c)]);
    }
  }
  return picture;
}

}  // namespace semview::picture
