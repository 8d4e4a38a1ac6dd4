// SPDX-License-Identifier: Apache-2.0
/// How costs grow with the size of a plan, its resolution, its classes and the panorama's size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::benchmark {

/// One generated office with one panorama, all on one thread.
struct GrowthPoint {
  std::string parameter;  ///< what is varied: "area_m2", "pixel_cm", "classes" or "columns"
  double value = 0.0;
  double columns_us = 0.0;    ///< a view's label runs by columns
  double packets_us = 0.0;    ///< the same by Embree packets
  double compass_us = 0.0;    ///< 120 headings of a view
  double stored_bytes = 0.0;  ///< a view
  double columns_ms = 0.0;    ///< to make the plan ready for columns
  double packets_ms = 0.0;    ///< to make it ready for Embree
  std::size_t triangles = 0;
};

struct GrowthConfig {
  bool quick = false;      ///< two small values of each parameter
  double budget_s = 0.15;  ///< of one measurement
};

/// All else is as in the office of 40 × 25 m at 5 cm with 11 classes and 360 × 90 pixels.
/// `progress` is called with (points done, points).
Result<std::vector<GrowthPoint>> measure_growth(
    const GrowthConfig& config, const std::function<void(std::size_t, std::size_t)>& progress);

std::string to_csv(std::span<const GrowthPoint> points);

/// @errors kUnavailable: the file cannot be written.
Status write_growth_svg(const std::filesystem::path& path, std::span<const GrowthPoint> points);

}  // namespace semview::benchmark
