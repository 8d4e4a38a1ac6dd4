// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/pinhole_renderer.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/raycast/image_caster.hpp"

namespace semview::raycast {
namespace {

tl::unexpected<Error> wrong(std::string field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::move(field)});
}

/// Unit rays; their parameter is a length, of which `depth` is the part along the optical axis.
///
/// The ray through a pixel is what its column and its row contribute, added up and made a unit
/// vector: a pixel takes a square root and no rotation.
class PinholeRays {
 public:
  explicit PinholeRays(const PinholeRequest& request) {
    const PinholeCamera& camera = request.camera;
    const Eigen::Matrix3d map_from_camera = request.map_from_camera.linear();
    for (int c = 0; c < camera.columns; ++c) {
      const double u = camera.direction(0, c).x();
      columns_.push_back({map_from_camera.col(0) * u + map_from_camera.col(2), u * u + 1.0});
    }
    for (int r = 0; r < camera.rows; ++r) {
      const double v = camera.direction(r, 0).y();
      rows_.push_back({map_from_camera.col(1) * v, v * v});
    }
  }

  RayDirection operator()(int row, int column) const {
    const Part& level = columns_[static_cast<std::size_t>(column)];
    const Part& tilt = rows_[static_cast<std::size_t>(row)];
    const double scale = 1.0 / std::sqrt(level.squared + tilt.squared);
    return {static_cast<float>((level.ray.x() + tilt.ray.x()) * scale),
            static_cast<float>((level.ray.y() + tilt.ray.y()) * scale),
            static_cast<float>((level.ray.z() + tilt.ray.z()) * scale)};
  }

  void tile(const TilePlace& place, TileDirections& directions) const {
    for (std::size_t i = 0; i < kTileRows; ++i) {
      for (std::size_t k = 0; k < kTileColumns; ++k) {
        const RayDirection d = (*this)(place.rows[i], place.columns[k]);
        const std::size_t lane = i * kTileColumns + k;
        directions.x[lane] = d.x;
        directions.y[lane] = d.y;
        directions.z[lane] = d.z;
      }
    }
  }

  float depth(int row, int column, float range_m) const {
    return static_cast<float>(range_m /
                              std::sqrt(columns_[static_cast<std::size_t>(column)].squared +
                                        rows_[static_cast<std::size_t>(row)].squared));
  }

 private:
  struct Part {
    Eigen::Vector3d ray;
    double squared;  ///< length in the optical frame
  };
  std::vector<Part> columns_, rows_;
};

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
  cast_tiles(caster, camera.rows, camera.columns, rays, store);
  return view;
}

}  // namespace semview::raycast
