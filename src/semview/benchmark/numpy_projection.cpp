// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/numpy_projection.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "semview/benchmark/peer.hpp"
#include "semview/benchmark/scratch_folder.hpp"

namespace semview::benchmark::detail {
namespace {

/// The points in the script's order.
Status write_points(const PointCloud& points, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  const auto write = [&file](const std::vector<float>& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(float)));
  };
  write(points.x_m);
  write(points.y_m);
  write(points.z_m);
  write({points.labels.begin(), points.labels.end()});
  file.close();
  if (file.good()) return {};
  return fail(ErrorCode::kUnavailable, path.string() + ": cannot be written");
}

/// What a command prints, by lines; fewer than expected if it failed.
std::vector<std::string> lines_of(const std::string& command) {
  std::vector<std::string> lines(1);
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += static_cast<char>(c);
    }
  }
  pclose(pipe);
  lines.pop_back();
  return lines;
}

LabelImage picture_of(const std::string& digits, const PanoramaCamera& camera) {
  LabelImage picture(camera.rows, camera.columns, kNoHit);
  for (std::size_t i = 0; i < picture.pixels().size() && 2 * i + 2 <= digits.size(); ++i) {
    std::from_chars(digits.data() + 2 * i, digits.data() + 2 * i + 2, picture.pixels()[i], 16);
  }
  return picture;
}

}  // namespace

Result<NumpyProjection> numpy_projection(const PointCloud& points,
                                         const std::vector<Eye>& eyes,
                                         const PanoramaCamera& camera,
                                         int rounds) {
  const std::string script = peers_folder() + "/point_projection.py";
  std::error_code ignored;
  if (!std::filesystem::exists(script, ignored)) {
    return fail(ErrorCode::kNotFound, "not installed: build with -DSEMVIEW_BUILD_BENCH=ON");
  }
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  const std::filesystem::path file = folder / "points.f32";
  SEMVIEW_TRY_STATUS(write_points(points, file));
  std::string places;
  for (const Eye& eye : eyes) places += fmt::format("{},{},{};", eye.x_m, eye.y_m, eye.z_m);
  places.pop_back();
  // Debian's modules belong to Debian's own interpreter, which need not be the first one.
  const std::vector<std::string> lines =
      lines_of(fmt::format("for python in python3 /usr/bin/python3; do $python -c 'import numpy' "
                           "2>/dev/null && exec $python '{}' '{}' {} {} '{}' {}; done",
                           script,
                           file.string(),
                           camera.columns,
                           camera.rows,
                           places,
                           rounds));
  if (lines.size() != static_cast<std::size_t>(rounds) + 1) {
    return fail(ErrorCode::kNotFound, "not installed: apt-get install python3-numpy");
  }
  std::vector<double> seconds;
  for (int i = 0; i < rounds; ++i)
    seconds.push_back(std::strtod(lines[static_cast<std::size_t>(i)].c_str(), nullptr));
  std::ranges::sort(seconds);
  return NumpyProjection{{seconds.front(), seconds[seconds.size() / 2]},
                         picture_of(lines.back(), camera)};
}

}  // namespace semview::benchmark::detail
