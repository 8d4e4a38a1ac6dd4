// SPDX-License-Identifier: Apache-2.0
/// The observation model of Gomez et al. 2023 as it is printed, pixel by pixel and in doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "semview/field/semantic_volume.hpp"
#include "semview/geometry/pose2.hpp"
#include "semview/map/column_map.hpp"
#include "semview/view/depth_observation.hpp"

namespace semview::reference {

/// The distances of equations (4) and (5), by looking at everything that there is.
class FieldTruth {
 public:
  virtual ~FieldTruth() = default;
  virtual double ground_height_m() const = 0;
  virtual const ClassTable& classes() const = 0;
  /// The point itself, or if it is farther from the map than the margin, the nearest place that is
  /// as far as the middle of the last cell.
  virtual Eigen::Vector3d inside(const Eigen::Vector3d& point_map) const = 0;
  /// sdf of the voxel that contains the point.
  virtual double sdf_m(const Eigen::Vector3d& point_map) const = 0;
  /// S: from the point itself to the centre of the closest voxel of the class; infinite if none.
  virtual double class_distance_m(ClassId label, const Eigen::Vector3d& point_map) const = 0;
};

/// A plan: each pixel's slabs, and its ground and ceiling where no slab touches them. In the plane
/// a thing is its pixel's centre.
class PlanTruth final : public FieldTruth {
 public:
  PlanTruth(const map::ColumnMap& plan, ClassTable classes, double margin_m)
      : plan_(plan), classes_(std::move(classes)), margin_m_(margin_m) {
    for (int row = 0; row < plan.rows(); ++row) {
      for (int column = 0; column < plan.columns(); ++column) add_things(row, column);
    }
  }

  double ground_height_m() const override { return plan_.ground_height_m; }
  const ClassTable& classes() const override { return classes_; }
  Eigen::Vector3d inside(const Eigen::Vector3d& point_map) const override {
    const double most_m = margin_m_ - 0.5 * plan_.resolution_m;
    const Eigen::Vector2d far(plan_.columns() * plan_.resolution_m + most_m,
                              plan_.rows() * plan_.resolution_m + most_m);
    const Eigen::Vector2d uv = plan_.plan_from_map(point_map.x(), point_map.y())
                                   .cwiseMax(Eigen::Vector2d::Constant(-most_m))
                                   .cwiseMin(far);
    const Eigen::Vector2d xy = plan_.map_from_plan(uv.x(), uv.y());
    return {xy.x(), xy.y(), point_map.z()};
  }
  double sdf_m(const Eigen::Vector3d& point_map) const override {
    double best = std::numeric_limits<double>::infinity();
    for (const Thing& thing : things_) best = std::min(best, thing.distance_m(point_map));
    return best;
  }
  double class_distance_m(ClassId label, const Eigen::Vector3d& point_map) const override {
    double best = std::numeric_limits<double>::infinity();
    for (const Thing& thing : things_) {
      if (thing.label == label) best = std::min(best, thing.distance_m(point_map));
    }
    return best;
  }

 private:
  struct Thing {
    ClassId label = kNoHit;
    Eigen::Vector2d centre_map;
    double low_m = 0.0;
    double high_m = 0.0;

    double distance_m(const Eigen::Vector3d& point_map) const {
      const double dz = std::max({low_m - point_map.z(), point_map.z() - high_m, 0.0});
      const Eigen::Vector2d apart = centre_map - point_map.head<2>();
      return std::sqrt(apart.squaredNorm() + dz * dz);
    }
  };

  void add_things(int row, int column) {
    const ColumnProfile& profile = plan_.profile(row, column);
    if (profile.outside) return;
    const Eigen::Vector2d centre = plan_.pixel_center({row, column});
    const double ground_m = plan_.ground_height_m;
    bool ground_seen = true;
    bool ceiling_seen = plan_.ceiling.has_value();
    for (const Slab& slab : profile.slabs) {
      things_.push_back({slab.label, centre, slab.z_min_m, slab.z_max_m});
      if (slab.z_min_m <= ground_m) ground_seen = false;
      if (plan_.ceiling && slab.z_max_m >= plan_.ceiling->height_m) ceiling_seen = false;
    }
    if (ground_seen) things_.push_back({profile.ground, centre, ground_m, ground_m});
    if (!ceiling_seen) return;
    const double ceiling_m = plan_.ceiling->height_m;
    things_.push_back({plan_.ceiling->label, centre, ceiling_m, ceiling_m});
  }

  const map::ColumnMap& plan_;
  ClassTable classes_;
  double margin_m_;
  std::vector<Thing> things_;
};

class VolumeTruth final : public FieldTruth {
 public:
  VolumeTruth(const field::SemanticVolume& volume, double ground_height_m, double margin_m)
      : volume_(volume), ground_height_m_(ground_height_m), margin_m_(margin_m), centres_(256) {
    for (const field::VoxelIndex& block : volume.block_indices()) {
      const Eigen::Array3d corner = 8.0 * Eigen::Array3d(block.x, block.y, block.z);
      low_ = low_.min(corner);
      high_ = high_.max(corner + 8.0);
      for (std::size_t i = 0; i < field::VoxelBlock::kVoxels; ++i) {
        centres_[volume.block(block)->most_likely_class(i)].push_back(
            volume.centre(field::SemanticVolume::voxel_of(block, i)));
      }
    }
  }

  double ground_height_m() const override { return ground_height_m_; }
  const ClassTable& classes() const override { return volume_.classes(); }
  Eigen::Vector3d inside(const Eigen::Vector3d& point_map) const override {
    const double voxel_m = volume_.shape().voxel_m;
    const Eigen::Array3d most(margin_m_ - 0.5 * voxel_m, margin_m_ - 0.5 * voxel_m, -0.5 * voxel_m);
    return point_map.array().max(voxel_m * low_ - most).min(voxel_m * high_ + most);
  }
  double sdf_m(const Eigen::Vector3d& point_map) const override {
    const field::VoxelIndex voxel = volume_.voxel_at(point_map);
    if (!(volume_.weight(voxel) > 0.0F)) return volume_.shape().truncation_m;
    return static_cast<double>(volume_.sdf_m(voxel));
  }
  double class_distance_m(ClassId label, const Eigen::Vector3d& point_map) const override {
    double best = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& centre : centres_[label]) {
      best = std::min(best, (centre - point_map).squaredNorm());
    }
    return std::sqrt(best);
  }

 private:
  const field::SemanticVolume& volume_;
  double ground_height_m_;
  double margin_m_;
  Eigen::Array3d low_ = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high_ = -low_;
  std::vector<std::vector<Eigen::Vector3d>> centres_;  // of the voxels of each class
};

/// The parameters of section 4.1. `reach_sigmas` is not in the paper: no distance counts as more.
struct FieldModel {
  double z_sdf = 0.5;
  double z_sem = 0.5;
  double sigma_sdf_m = 2.0;
  double sigma_sem_m = 1.5;
  double reach_sigmas = 4.0;
};

struct LiteralLikelihood {
  double log_p = 0.0;  ///< the logarithm of equation (2) without η
  int pixels = 0;

  double mean() const { return log_p / pixels; }
};

inline LiteralLikelihood literal_likelihood(const DepthObservation& observation,
                                            const FieldTruth& truth,
                                            const FieldModel& model,
                                            const Pose2& map_from_base) {
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translate(
      Eigen::Vector3d(map_from_base.x_m, map_from_base.y_m, truth.ground_height_m()));
  map_from_camera.rotate(Eigen::AngleAxisd(map_from_base.yaw_rad, Eigen::Vector3d::UnitZ()));
  map_from_camera = map_from_camera * observation.base_from_camera;
  const PinholeCamera& camera = observation.camera;
  LiteralLikelihood sum;
  for (int row = 0; row < camera.rows; ++row) {
    for (int column = 0; column < camera.columns; ++column) {
      const double depth = static_cast<double>(observation.depth_m.at(row, column));
      if (!(depth > 0.0)) continue;
      const double a = column + 0.5;
      const double b = row + 0.5;
      // Equation (1).
      const Eigen::Vector3d x((a - camera.cx_px) / camera.fx_px * depth,
                              (b - camera.cy_px) / camera.fy_px * depth,
                              depth);
      const Eigen::Vector3d point_map = truth.inside(map_from_camera * x);
      const ClassId observed = observation.labels.at(row, column);
      double z_sdf = model.z_sdf;
      double z_sem = model.z_sem;
      if (observed == kUnknown) {
        if (z_sdf == 0.0) continue;
        z_sdf = 1.0;
        z_sem = 0.0;
      }
      const double sdf =
          std::min(model.reach_sigmas * model.sigma_sdf_m, std::abs(truth.sdf_m(point_map)));
      double s = model.reach_sigmas * model.sigma_sem_m;
      if (observed != kUnknown) {
        const auto label = truth.classes().id(observation.classes.name(observed));
        if (label) s = std::min(s, truth.class_distance_m(*label, point_map));
      }
      // Equations (4), (5), (3) and (2).
      const double p_sdf = std::exp(-sdf * sdf / (2.0 * model.sigma_sdf_m * model.sigma_sdf_m));
      const double p_sem = std::exp(-s * s / (2.0 * model.sigma_sem_m * model.sigma_sem_m));
      sum.log_p += std::log(z_sdf * p_sdf + z_sem * p_sem);
      ++sum.pixels;
    }
  }
  return sum;
}

}  // namespace semview::reference
