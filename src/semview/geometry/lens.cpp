// SPDX-License-Identifier: Apache-2.0
#include "semview/geometry/lens.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "semview/geometry/angle.hpp"

namespace semview {
namespace {

constexpr double kMaxCoefficient = 1000.0;
constexpr int kSteps = 2000;         ///< of the search for the point where a polynomial turns back
constexpr double kMaxRadius = 20.0;  ///< of the plumb-bob model at z = 1: 87° off the axis
constexpr double kMaxAngle_rad = kPi;
constexpr int kMaxIterations = 50;
constexpr double kTolerance = 1.0e-12;
constexpr double kGoodEnough = 1.0e-9;

/// radius · (1 + k1 r² + k2 r⁴ + k3 r⁶)
double plumb_bob_radius(const Lens::Coefficients& k, double radius) {
  const double r2 = radius * radius;
  return radius * (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4])));
}

/// θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)
double equidistant_radius(const Lens::Coefficients& k, double angle_rad) {
  const double a2 = angle_rad * angle_rad;
  return angle_rad * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

/// The last of equally spaced values in [0, end] up to which `radius` grows.
template <typename Radius>
double growing_until(double end, const Radius& radius) {
  double last = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double next = end * i / kSteps;
    if (!(radius(next) > radius(last))) break;
    last = next;
  }
  return last;
}

/// x in [0, limit] with radius(x) = wanted, of a growing function.
template <typename Radius>
std::optional<double> inverse_of(double wanted, double limit, const Radius& radius) {
  if (!(wanted <= radius(limit))) return std::nullopt;
  double low = 0.0;
  double high = limit;
  for (int i = 0; i < kMaxIterations && high - low > kTolerance; ++i) {
    const double middle = 0.5 * (low + high);
    (radius(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Result<Lens> Lens::make(Model model, const Coefficients& coefficients) {
  Lens lens;
  lens.model_ = model;
  const std::size_t count = model == Model::kNone ? 0 : model == Model::kPlumbBob ? 5 : 4;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(std::abs(coefficients[i]) <= kMaxCoefficient)) {
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("distortion coefficient {:g}, expected -{:g} to {:g}",
                                    coefficients[i],
                                    kMaxCoefficient,
                                    kMaxCoefficient),
                        "coefficients"});
    }
    lens.k_[i] = coefficients[i];
  }
  if (model == Model::kPlumbBob) {
    lens.limit_ = growing_until(kMaxRadius, [&](double r) { return plumb_bob_radius(lens.k_, r); });
  } else if (model == Model::kEquidistant) {
    lens.limit_ =
        growing_until(kMaxAngle_rad, [&](double a) { return equidistant_radius(lens.k_, a); });
  }
  return lens;
}

Eigen::Vector2d Lens::distort_plumb_bob(const Eigen::Vector2d& straight) const {
  const double x = straight.x();
  const double y = straight.y();
  const double r2 = straight.squaredNorm();
  const double radial = 1.0 + r2 * (k_[0] + r2 * (k_[1] + r2 * k_[4]));
  const double p1 = k_[2];
  const double p2 = k_[3];
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

std::optional<Eigen::Vector2d> Lens::project(const Eigen::Vector3d& direction) const {
  if (model_ == Model::kEquidistant) {
    const double off_axis = std::hypot(direction.x(), direction.y());
    const double angle_rad = std::atan2(off_axis, direction.z());
    if (angle_rad > limit_) return std::nullopt;
    if (off_axis == 0.0) return Eigen::Vector2d(0.0, 0.0);
    const double scale = equidistant_radius(k_, angle_rad) / off_axis;
    return Eigen::Vector2d(direction.x() * scale, direction.y() * scale);
  }
  if (!(direction.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d straight(direction.x() / direction.z(), direction.y() / direction.z());
  if (model_ == Model::kNone) return straight;
  if (straight.norm() > limit_) return std::nullopt;
  return distort_plumb_bob(straight);
}

std::optional<Eigen::Vector2d> Lens::undistort_plumb_bob(const Eigen::Vector2d& point) const {
  // From the radial inverse Newton's steps need to mend only the small tangential part.
  const double distorted_radius = point.norm();
  const auto radius = [this](double r) { return plumb_bob_radius(k_, r); };
  const std::optional<double> start =
      inverse_of(std::min(distorted_radius, radius(limit_)), limit_, radius);
  Eigen::Vector2d straight =
      distorted_radius > 0.0 ? Eigen::Vector2d(point * (*start / distorted_radius)) : point;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d error = distort_plumb_bob(straight) - point;
    if (error.norm() < kTolerance) break;
    constexpr double kStep = 1.0e-6;
    Eigen::Matrix2d jacobian;
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Vector2d aside = Eigen::Vector2d::Zero();
      aside[axis] = kStep;
      jacobian.col(axis) =
          (distort_plumb_bob(straight + aside) - distort_plumb_bob(straight - aside)) /
          (2.0 * kStep);
    }
    if (std::abs(jacobian.determinant()) < kGoodEnough) return std::nullopt;
    straight -= jacobian.inverse() * error;
  }
  if (!((distort_plumb_bob(straight) - point).norm() < kGoodEnough)) return std::nullopt;
  if (straight.norm() > limit_) return std::nullopt;
  return straight;
}

std::optional<Eigen::Vector3d> Lens::unproject(const Eigen::Vector2d& point) const {
  if (model_ == Model::kEquidistant) {
    const double radius = point.norm();
    const std::optional<double> angle_rad =
        inverse_of(radius, limit_, [this](double a) { return equidistant_radius(k_, a); });
    if (!angle_rad) return std::nullopt;
    if (radius == 0.0) return Eigen::Vector3d::UnitZ();
    const double scale = std::sin(*angle_rad) / radius;
    return Eigen::Vector3d(point.x() * scale, point.y() * scale, std::cos(*angle_rad));
  }
  Eigen::Vector2d straight = point;
  if (model_ == Model::kPlumbBob) {
    const std::optional<Eigen::Vector2d> undistorted = undistort_plumb_bob(point);
    if (!undistorted) return std::nullopt;
    straight = *undistorted;
  }
  return Eigen::Vector3d(straight.x(), straight.y(), 1.0).normalized();
}

}  // namespace semview
