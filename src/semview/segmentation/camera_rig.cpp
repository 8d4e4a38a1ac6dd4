// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/camera_rig.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "semview/io/camera_yaml.hpp"
#include "semview/io/yaml_document.hpp"

namespace semview::segmentation {
namespace {

using io::YamlNode;

constexpr int kFormat = 1;

struct LensKind {
  std::string_view name;
  Lens::Model model;
  std::size_t coefficients;
};
constexpr std::array<LensKind, 3> kLenses{{{"none", Lens::Model::kNone, 0},
                                           {"plumb_bob", Lens::Model::kPlumbBob, 5},
                                           {"equidistant", Lens::Model::kEquidistant, 4}}};

Result<Lens> parse_lens(const YamlNode& camera) {
  const std::optional<YamlNode> node = camera.find("distortion");
  if (!node) return Lens();
  SEMVIEW_TRY_STATUS(node->expect_keys({"model", "coefficients"}));
  SEMVIEW_TRY(const YamlNode model, node->at("model"));
  SEMVIEW_TRY(const std::string name, model.text());
  const LensKind* kind = nullptr;
  for (const LensKind& known : kLenses) {
    if (known.name == name) kind = &known;
  }
  if (kind == nullptr) {
    return model.error(
        fmt::format("distortion '{}', expected none, plumb_bob or equidistant", name));
  }
  Lens::Coefficients coefficients{};
  const std::optional<YamlNode> list = node->find("coefficients");
  if (kind->coefficients > 0 || list) {
    SEMVIEW_TRY(const YamlNode given, node->at("coefficients"));
    SEMVIEW_TRY(const std::vector<double> numbers, given.numbers(kind->coefficients));
    std::copy(numbers.begin(), numbers.end(), coefficients.begin());
  }
  Result<Lens> lens = Lens::make(kind->model, coefficients);
  if (!lens) return node->error(lens.error().message);
  return lens;
}

Result<NamedCamera> parse_camera(const YamlNode& node, std::size_t number) {
  SEMVIEW_TRY_STATUS(
      node.expect_keys({"name", "pinhole", "equirectangular", "distortion", "base_from_camera"}));
  NamedCamera named;
  SEMVIEW_TRY(named.name, node.text_or("name", fmt::format("camera {}", number)));
  SEMVIEW_TRY(const io::CameraMount mount, io::parse_mount(node));
  const std::optional<YamlNode> pinhole = node.find("pinhole");
  const std::optional<YamlNode> whole = node.find("equirectangular");
  if (pinhole.has_value() == whole.has_value()) {
    return node.error("expected either 'pinhole' or 'equirectangular'");
  }
  if (pinhole) {
    LensCamera camera;
    SEMVIEW_TRY(camera.pinhole, io::parse_pinhole(*pinhole));
    SEMVIEW_TRY(camera.lens, parse_lens(node));
    camera.base_from_camera = io::base_from_optical(mount);
    named.camera = camera;
    return named;
  }
  if (const std::optional<YamlNode> distortion = node.find("distortion")) {
    return distortion->error("an equirectangular photograph has no distortion");
  }
  EquirectangularCamera camera;
  SEMVIEW_TRY(camera.photo, io::parse_panorama(*whole));
  camera.base_from_camera = io::base_from_level(mount);
  named.camera = camera;
  return named;
}

}  // namespace

Eigen::Vector3d CameraRig::eye_m() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NamedCamera& named : cameras) sum += base_from(named.camera).translation();
  return cameras.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(cameras.size()));
}

Result<CameraRig> read_camera_rig(const std::filesystem::path& path) {
  SEMVIEW_TRY(const YamlNode document, io::read_yaml(path));
  SEMVIEW_TRY_STATUS(document.expect_keys({"format", "cameras"}));
  SEMVIEW_TRY(const YamlNode format_node, document.at("format"));
  SEMVIEW_TRY(const std::int64_t format, format_node.integer());
  if (format != kFormat) {
    return fail(
        ErrorCode::kUnimplemented,
        fmt::format("{}: format {}, this version reads {}", format_node.where(), format, kFormat));
  }
  SEMVIEW_TRY(const YamlNode cameras, document.at("cameras"));
  const std::vector<YamlNode> items = cameras.items();
  if (items.empty() || items.size() > kMaxRigCameras) {
    return cameras.error(fmt::format("{} cameras, expected 1 to {}", items.size(), kMaxRigCameras));
  }
  CameraRig rig;
  for (const YamlNode& item : items) {
    SEMVIEW_TRY(NamedCamera camera, parse_camera(item, rig.cameras.size() + 1));
    rig.cameras.push_back(std::move(camera));
  }
  return rig;
}

CameraRig equirectangular_rig(double height_m) {
  EquirectangularCamera camera;
  camera.photo.elevation_min_rad = -kPi / 2.0;
  camera.photo.elevation_max_rad = kPi / 2.0;
  camera.base_from_camera.translation() = Eigen::Vector3d(0.0, 0.0, height_m);
  return {{{"equirectangular", camera}}};
}

CameraRig rig_of(const ObservationCamera& camera) {
  if (const auto* mounted = std::get_if<MountedPinhole>(&camera)) {
    return {{{"pinhole", LensCamera{mounted->camera, Lens(), mounted->base_from_camera}}}};
  }
  EquirectangularCamera whole;
  whole.photo = std::get<PartialPanorama>(camera);
  whole.base_from_camera.translation() = whole.photo.position_m;
  return {{{"panorama", whole}}};
}

}  // namespace semview::segmentation
