// SPDX-License-Identifier: Apache-2.0
#include "semview/map/distorted_bundle.hpp"

#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/map/bundle_writer.hpp"
#include "semview/map/distortion.hpp"
#include "semview/map/map_file.hpp"
#include "semview/map/map_problem.hpp"
#include "semview/map/object_writer.hpp"
#include "semview/map/occupancy.hpp"

namespace semview::map {
namespace {

using Path = std::filesystem::path;

/// The drawing in the colours of its class list, objects in that of their class.
RgbImage drawing_of(const SemanticMap& map, Rgb outside) {
  const std::vector<Rgb> colors = profile_colors(map, outside);
  const ColumnMap& columns = *map.columns();
  RgbImage drawing(columns.rows(), columns.columns());
  for (int row = 0; row < columns.rows(); ++row) {
    for (int column = 0; column < columns.columns(); ++column) {
      drawing.at(row, column) = colors[columns.profile_of_pixel.at(row, column)];
    }
  }
  return drawing;
}

detail::BundleText text_of(const detail::MapFile& file,
                           const SemanticMap& distorted,
                           const MapAffine& affine) {
  const ColumnMap& columns = *distorted.columns();
  detail::BundleText text;
  text.name = file.name;
  text.comment = fmt::format(
      "{}, every point moved by [[{}, 0], [{}, {}]].", file.id, affine.a, affine.k, affine.b);
  text.resolution_m = columns.resolution_m;
  text.origin = columns.origin;
  text.ground_class = file.ground.class_name.text;
  text.ground_height_m = file.ground.height_m;
  if (file.ceiling) {
    text.ceiling_class = file.ceiling->class_name.text;
    text.ceiling_height_m = file.ceiling->height_m;
  }
  text.outside = file.outside;
  for (const detail::ClassField& field : file.classes) text.classes.push_back(field.value);
  text.objects = detail::objects_text(distorted);
  return text;
}

/// What is in the folder and no part of the map: weights, licences, notes.
Status copy_the_rest(const detail::MapFile& file, const Path& directory) {
  const Path from = file.path.parent_path();
  std::error_code error;
  const std::set<Path> parts{file.path.filename(),
                             file.labels.text,
                             file.image.text,
                             file.objects.text,
                             "objects.geojson",
                             file.classes_path.filename(),
                             "map.yaml",
                             "labels.png",
                             "occupancy.png"};
  for (const auto& entry : std::filesystem::directory_iterator(from, error)) {
    std::error_code ignored;
    if (!entry.is_regular_file(ignored) || parts.contains(entry.path().filename())) continue;
    std::filesystem::copy_file(entry.path(),
                               directory / entry.path().filename(),
                               std::filesystem::copy_options::overwrite_existing,
                               error);
    if (error) break;
  }
  if (!error) return {};
  return fail(ErrorCode::kUnavailable,
              fmt::format("{}: its files cannot be copied to {}: {}",
                          from.string(),
                          directory.string(),
                          error.message()));
}

}  // namespace

Status write_distorted(const Path& path,
                       const MapAffine& affine,
                       const Path& directory,
                       const LoadOptions& options) {
  SEMVIEW_TRY(const SemanticMap drawn, load_map(path, options));
  SEMVIEW_TRY(const SemanticMap distorted, distort(drawn, affine));
  MapReport report;
  std::error_code ignored;
  const std::optional<detail::MapFile> file = detail::read_map_file(
      std::filesystem::is_directory(path, ignored) ? path / "map.yaml" : path, report);
  if (!file) return fail(first_error(report));
  SEMVIEW_TRY_STATUS(detail::write_bundle(
      text_of(*file, distorted, affine), drawing_of(distorted, file->outside), directory));
  return copy_the_rest(*file, directory);
}

}  // namespace semview::map
