// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/pinhole_renderer.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/ray_caster.hpp"

namespace semview::raycast {
namespace {

tl::unexpected<Error> wrong(std::string field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::move(field)});
}

/// Unit rays; their parameter is a length, of which `depth` is the part along the optical axis.
struct PinholeRays {
  explicit PinholeRays(const PinholeRequest& request)
      : camera(request.camera), map_from_camera(request.map_from_camera.linear()) {}

  RayDirection operator()(int row, int column) const {
    const Eigen::Vector3d direction = map_from_camera * camera.direction(row, column).normalized();
    return {static_cast<float>(direction.x()),
            static_cast<float>(direction.y()),
            static_cast<float>(direction.z())};
  }

  float depth(int row, int column, float range_m) const {
    return static_cast<float>(range_m / camera.direction(row, column).norm());
  }

  PinholeCamera camera;
  Eigen::Matrix3d map_from_camera;
};

template <typename CastImage>
PinholeView render(const Scene& scene, const PinholeRequest& request, const CastImage& cast_image) {
  const Eigen::Vector3f eye = request.map_from_camera.translation().cast<float>();
  const RayCaster caster(scene, eye.x(), eye.y(), eye.z());
  const PinholeCamera& camera = request.camera;
  PinholeView view{LabelImage(camera.rows, camera.columns),
                   RangeImage(camera.rows, camera.columns)};
  const PinholeRays rays(request);
  const auto store = [&](int row, int column, const RayHit& hit) {
    view.labels.at(row, column) = hit.label;
    view.depths_m.at(row, column) = rays.depth(row, column, hit.parameter);
  };
  cast_image(caster, camera.rows, camera.columns, rays, store);
  return view;
}

}  // namespace

Status validate(const PinholeRequest& request) {
  const Eigen::Matrix3d rotation = request.map_from_camera.linear();
  const Eigen::Vector3d eye = request.map_from_camera.translation();
  if (!rotation.allFinite() || !eye.allFinite() ||
      eye.cwiseAbs().maxCoeff() > PoseGrid::kMaxCoordinate_m) {
    return wrong(
        "pose",
        fmt::format("camera pose must be finite and within {:g} m", PoseGrid::kMaxCoordinate_m));
  }
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() >
          1e-6 ||
      rotation.determinant() < 0.0) {
    return wrong("pose", "camera orientation must be a rotation");
  }
  const PinholeCamera& camera = request.camera;
  if (camera.columns < 1 || camera.columns > kMaxPinholeColumns) {
    return wrong("columns",
                 fmt::format("columns {} must be 1 to {}", camera.columns, kMaxPinholeColumns));
  }
  if (camera.rows < 1 || camera.rows > kMaxPinholeRows) {
    return wrong("rows", fmt::format("rows {} must be 1 to {}", camera.rows, kMaxPinholeRows));
  }
  const auto is_focal = [](double length_px) {
    return length_px >= kMinFocalLength_px && length_px <= kMaxFocalLength_px;
  };
  if (!is_focal(camera.fx_px) || !is_focal(camera.fy_px)) {
    return wrong(
        "pinhole",
        fmt::format("focal lengths {:g} and {:g} px must be 1 to 1e6", camera.fx_px, camera.fy_px));
  }
  if (!(std::abs(camera.cx_px) <= kMaxPrincipalPoint_px &&
        std::abs(camera.cy_px) <= kMaxPrincipalPoint_px)) {
    return wrong(
        "pinhole",
        fmt::format(
            "principal point ({:g}, {:g}) px must be within ±1e6", camera.cx_px, camera.cy_px));
  }
  return {};
}

PinholeView render_pinhole(const Scene& scene, const PinholeRequest& request) {
  return render(scene, request, [](const auto&... image) { cast_tiles(image...); });
}

PinholeView render_pinhole_single_rays(const Scene& scene, const PinholeRequest& request) {
  return render(scene, request, [](const auto&... image) { cast_singly(image...); });
}

}  // namespace semview::raycast
