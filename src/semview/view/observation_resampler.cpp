// SPDX-License-Identifier: Apache-2.0
#include "semview/view/observation_resampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview {
namespace {

constexpr int kMaxSide_px = 20'000;
constexpr std::int32_t kNowhere = -1;

tl::unexpected<Error> wrong(std::string field, std::string message) {
  return fail(Error{ErrorCode::kInvalidArgument, std::move(message), std::move(field)});
}

Status check_size(int rows, int columns) {
  if (rows < 1 || rows > kMaxSide_px || columns < 1 || columns > kMaxSide_px) {
    return wrong(
        "size",
        fmt::format(
            "camera image of {} x {} pixels, expected 1 to {} each", columns, rows, kMaxSide_px));
  }
  return {};
}

Status check(const PartialPanorama& camera) {
  SEMVIEW_TRY_STATUS(check_size(camera.rows, camera.columns));
  const double turn = camera.azimuth_left_rad - camera.azimuth_right_rad;
  // A degree written with ten digits must not make a full turn too large.
  constexpr double kSlack = 1.0e-6;
  if (!(turn > 0.0 && turn <= kTwoPi + kSlack) || !std::isfinite(camera.azimuth_left_rad)) {
    return wrong("azimuth",
                 fmt::format("azimuth {:g} (left) to {:g} (right) degrees must decrease by at most "
                             "360",
                             deg_from_rad(camera.azimuth_left_rad),
                             deg_from_rad(camera.azimuth_right_rad)));
  }
  const double limit = kPi / 2.0 + kSlack;
  if (!(camera.elevation_min_rad >= -limit && camera.elevation_max_rad <= limit &&
        camera.elevation_min_rad < camera.elevation_max_rad)) {
    return wrong("elevation",
                 fmt::format("elevation {:g} to {:g} degrees must increase within -90 to 90",
                             deg_from_rad(camera.elevation_min_rad),
                             deg_from_rad(camera.elevation_max_rad)));
  }
  if (!camera.position_m.allFinite()) return wrong("position", "camera position is not finite");
  return {};
}

Status check(const MountedPinhole& mounted) {
  const PinholeCamera& camera = mounted.camera;
  SEMVIEW_TRY_STATUS(check_size(camera.rows, camera.columns));
  const bool finite = std::isfinite(camera.fx_px) && std::isfinite(camera.fy_px) &&
                      std::isfinite(camera.cx_px) && std::isfinite(camera.cy_px);
  if (!finite || camera.fx_px <= 0.0 || camera.fy_px <= 0.0) {
    return wrong("intrinsics",
                 fmt::format("fx {:g}, fy {:g}, cx {:g}, cy {:g}: expected finite numbers, fx and "
                             "fy above 0",
                             camera.fx_px,
                             camera.fy_px,
                             camera.cx_px,
                             camera.cy_px));
  }
  if (!mounted.base_from_camera.matrix().allFinite()) {
    return wrong("base_from_camera", "camera pose is not finite");
  }
  return {};
}

// The profile pixel (row · columns + column) into which the centre of each source pixel falls, and
// the source pixel into which the centre of a profile pixel falls; `kNowhere` where there is none.

std::vector<std::int32_t> targets_of(const PartialPanorama& source, const PanoramaCamera& profile) {
  std::vector<int> column_of(static_cast<std::size_t>(source.columns));
  for (int c = 0; c < source.columns; ++c) {
    const double turned = (c + 0.5) * (source.azimuth_left_rad - source.azimuth_right_rad);
    column_of[static_cast<std::size_t>(c)] =
        profile.column_of(source.azimuth_left_rad - turned / source.columns);
  }
  std::vector<std::int32_t> targets;
  targets.reserve(static_cast<std::size_t>(source.rows) * column_of.size());
  for (int r = 0; r < source.rows; ++r) {
    const double sunk = (r + 0.5) * (source.elevation_max_rad - source.elevation_min_rad);
    const int row = profile.row_of(source.elevation_max_rad - sunk / source.rows);
    for (const int column : column_of) {
      targets.push_back(row < 0 ? kNowhere : row * profile.columns + column);
    }
  }
  return targets;
}

std::vector<std::int32_t> targets_of(const MountedPinhole& source, const PanoramaCamera& profile) {
  const Eigen::Matrix3d base_from_camera = source.base_from_camera.linear();
  std::vector<std::int32_t> targets;
  targets.reserve(static_cast<std::size_t>(source.camera.rows) *
                  static_cast<std::size_t>(source.camera.columns));
  for (int r = 0; r < source.camera.rows; ++r) {
    for (int c = 0; c < source.camera.columns; ++c) {
      const Eigen::Vector3d d = base_from_camera * source.camera.direction(r, c);
      const int row = profile.row_of(std::atan2(d.z(), std::hypot(d.x(), d.y())));
      const int column = profile.column_of(std::atan2(d.y(), d.x()));
      targets.push_back(row < 0 ? kNowhere : row * profile.columns + column);
    }
  }
  return targets;
}

std::int32_t source_at(const PartialPanorama& source,
                       const PanoramaCamera& profile,
                       int row,
                       int column) {
  double from_left = source.azimuth_left_rad - profile.azimuth_rad(column);
  from_left -= kTwoPi * std::floor(from_left / kTwoPi);
  const double turn = source.azimuth_left_rad - source.azimuth_right_rad;
  const double from_top = source.elevation_max_rad - profile.elevation_rad(row);
  const int c = static_cast<int>(std::floor(from_left / turn * source.columns));
  const int r = static_cast<int>(
      std::floor(from_top / (source.elevation_max_rad - source.elevation_min_rad) * source.rows));
  if (c < 0 || c >= source.columns || r < 0 || r >= source.rows) return kNowhere;
  return r * source.columns + c;
}

std::int32_t source_at(const MountedPinhole& source,
                       const PanoramaCamera& profile,
                       int row,
                       int column) {
  const PinholeCamera& camera = source.camera;
  const Eigen::Vector3d d =
      source.base_from_camera.linear().transpose() * profile.direction(row, column);
  if (d.z() <= 0.0) return kNowhere;
  const double u = camera.fx_px * d.x() / d.z() + camera.cx_px;
  const double v = camera.fy_px * d.y() / d.z() + camera.cy_px;
  if (!(u >= 0.0 && u < camera.columns && v >= 0.0 && v < camera.rows)) return kNowhere;
  return static_cast<int>(v) * camera.columns + static_cast<int>(u);
}

ClassId seen(ClassId label) { return label == kNoHit ? kUnknown : label; }

ClassId majority(std::span<const ClassId> votes) {
  std::array<std::int32_t, 256> counts{};
  for (const ClassId vote : votes) ++counts[vote];
  return static_cast<ClassId>(std::ranges::max_element(counts) - counts.begin());
}

/// The labels sorted by target pixel: those of target t are [first[t], first[t + 1]).
struct Votes {
  std::vector<std::size_t> first;
  std::vector<ClassId> labels;
};

Votes sort_by_target(std::span<const ClassId> labels,
                     std::span<const std::int32_t> targets,
                     std::size_t target_count) {
  Votes votes;
  votes.first.assign(target_count + 1, 0);
  for (const std::int32_t target : targets) {
    if (target != kNowhere) ++votes.first[static_cast<std::size_t>(target) + 1];
  }
  for (std::size_t t = 0; t < target_count; ++t) votes.first[t + 1] += votes.first[t];
  std::vector<std::size_t> next(votes.first.begin(), votes.first.end() - 1);
  votes.labels.resize(votes.first.back());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] == kNowhere) continue;
    votes.labels[next[static_cast<std::size_t>(targets[i])]++] = seen(labels[i]);
  }
  return votes;
}

template <typename Camera>
LabelImage resample_from(const LabelImage& labels,
                         const Camera& camera,
                         const PanoramaCamera& profile) {
  const auto target_count =
      static_cast<std::size_t>(profile.rows) * static_cast<std::size_t>(profile.columns);
  const Votes votes = sort_by_target(labels.pixels(), targets_of(camera, profile), target_count);
  LabelImage resampled(profile.rows, profile.columns, kUnknown);
  std::size_t t = 0;
  for (int row = 0; row < profile.rows; ++row) {
    for (int column = 0; column < profile.columns; ++column, ++t) {
      const std::size_t count = votes.first[t + 1] - votes.first[t];
      if (count > 0) {
        resampled.at(row, column) =
            majority(std::span(votes.labels).subspan(votes.first[t], count));
      } else if (const std::int32_t nearest = source_at(camera, profile, row, column);
                 nearest != kNowhere) {
        resampled.at(row, column) = seen(labels.pixels()[static_cast<std::size_t>(nearest)]);
      }
    }
  }
  return resampled;
}

template <typename Camera>
Image<std::uint8_t> resample_confidence_from(const Image<std::uint8_t>& confidence,
                                             const LabelImage& labels,
                                             const Camera& camera,
                                             const PanoramaCamera& profile,
                                             const LabelImage& resampled) {
  const std::vector<std::int32_t> targets = targets_of(camera, profile);
  std::vector<std::uint32_t> sums(resampled.pixels().size());
  std::vector<std::uint32_t> counts(resampled.pixels().size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i] == kNowhere) continue;
    const auto target = static_cast<std::size_t>(targets[i]);
    ++counts[target];
    if (seen(labels.pixels()[i]) == resampled.pixels()[target]) {
      sums[target] += confidence.pixels()[i];
    }
  }
  Image<std::uint8_t> sure(profile.rows, profile.columns, 0);
  std::size_t t = 0;
  for (int row = 0; row < profile.rows; ++row) {
    for (int column = 0; column < profile.columns; ++column, ++t) {
      if (resampled.at(row, column) == kUnknown) continue;
      if (counts[t] > 0) {
        sure.at(row, column) = static_cast<std::uint8_t>((sums[t] + counts[t] / 2) / counts[t]);
      } else if (const std::int32_t nearest = source_at(camera, profile, row, column);
                 nearest != kNowhere) {
        sure.at(row, column) = confidence.pixels()[static_cast<std::size_t>(nearest)];
      }
    }
  }
  return sure;
}

int rows_of(const PartialPanorama& camera) { return camera.rows; }
int rows_of(const MountedPinhole& camera) { return camera.camera.rows; }
int columns_of(const PartialPanorama& camera) { return camera.columns; }
int columns_of(const MountedPinhole& camera) { return camera.camera.columns; }

}  // namespace

Pose2 base_from_eye(const ObservationCamera& camera) {
  const auto* panorama = std::get_if<PartialPanorama>(&camera);
  const Eigen::Vector3d position =
      panorama != nullptr
          ? panorama->position_m
          : Eigen::Vector3d(std::get<MountedPinhole>(camera).base_from_camera.translation());
  return {position.x(), position.y(), 0.0};
}

Status validate(const ObservationCamera& camera) {
  return std::visit([](const auto& kind) { return check(kind); }, camera);
}

LabelImage resample(const LabelImage& labels,
                    const ObservationCamera& camera,
                    const PanoramaCamera& profile) {
  return std::visit(
      [&](const auto& kind) {
        SEMVIEW_CHECK(labels.rows() == rows_of(kind) && labels.columns() == columns_of(kind));
        return resample_from(labels, kind, profile);
      },
      camera);
}

Image<std::uint8_t> resample_confidence(const Image<std::uint8_t>& confidence,
                                        const LabelImage& labels,
                                        const ObservationCamera& camera,
                                        const PanoramaCamera& profile,
                                        const LabelImage& resampled) {
  SEMVIEW_CHECK(confidence.rows() == labels.rows() && confidence.columns() == labels.columns());
  SEMVIEW_CHECK(resampled.rows() == profile.rows && resampled.columns() == profile.columns);
  return std::visit(
      [&](const auto& kind) {
        SEMVIEW_CHECK(labels.rows() == rows_of(kind) && labels.columns() == columns_of(kind));
        return resample_confidence_from(confidence, labels, kind, profile, resampled);
      },
      camera);
}

}  // namespace semview
