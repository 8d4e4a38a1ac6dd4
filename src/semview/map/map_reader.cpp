// SPDX-License-Identifier: Apache-2.0
#include "semview/map/map_reader.hpp"

#include <cmath>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "semview/geometry/pose_grid.hpp"
#include "semview/io/png.hpp"
#include "semview/map/class_rules.hpp"
#include "semview/map/fingerprint.hpp"
#include "semview/map/label_plan.hpp"
#include "semview/map/map_file.hpp"
#include "semview/map/map_limits.hpp"
#include "semview/map/mesh_map_reader.hpp"
#include "semview/map/object_drawing.hpp"
#include "semview/map/object_rules.hpp"

namespace semview::map::detail {
namespace {

using Path = std::filesystem::path;

/// What a map is without its geometry.
SemanticMap map_of(const MapFile& file) {
  SemanticMap map;
  map.id = file.id;
  map.name = file.name;
  map.directory = file.path.parent_path();
  std::vector<std::string> names;
  for (const ClassField& field : file.classes) {
    names.push_back(field.value.name);
    map.class_details.push_back(field.value);
  }
  map.classes = ClassTable(std::move(names));
  const Storey storey = storey_of(file, map.classes);
  map.ground_height_m = storey.ground_height_m;
  map.ground_label = storey.ground_label;
  map.ceiling = storey.ceiling;
  return map;
}

void check_size(const MapFile& file, const Path& labels, io::PngSize size, MapReport& report) {
  if (!is_valid_resolution(file.resolution_m)) return;  // said already
  const double cell_m = PoseGrid::kCellSize_m;
  const double width_m = size.columns * file.resolution_m;
  const double height_m = size.rows * file.resolution_m;
  const double reach_m = std::hypot(width_m, height_m);
  // A turned image covers at most its diagonal's square.
  const bool turned = file.origin.yaw_rad != 0.0;
  const double area_m2 = turned ? reach_m * reach_m : width_m * height_m;
  if (area_m2 / (cell_m * cell_m) <= static_cast<double>(kMaxGridCells)) return;
  report.problems.push_back(
      file_problem(Severity::kError,
                   labels,
                   fmt::format("{} x {} pixels of {} m are {:.0f} m x {:.0f} m, which is too large",
                               size.columns,
                               size.rows,
                               file.resolution_m,
                               width_m,
                               height_m),
                   fmt::format("a map covers at most {:.0f} m2; is the resolution right?",
                               static_cast<double>(kMaxGridCells) * cell_m * cell_m)));
}

/// The occupancy image is for other programs; here it is only checked that it fits.
void check_occupancy(const MapFile& file, io::PngSize labels, MapReport& report) {
  if (file.image.line == 0) return;
  const Path path = file.path.parent_path() / file.image.text;
  if (!std::filesystem::exists(path)) return;  // allowed: `semview map occupancy` draws it
  if (path.extension() != ".png") return;
  const Result<io::PngSize> size = io::png_size(path);
  if (!size) {
    MapProblem problem = problem_of(path, size.error());
    problem.severity = Severity::kWarning;
    report.problems.push_back(std::move(problem));
  } else if (size->rows != labels.rows || size->columns != labels.columns) {
    report.problems.push_back(file_problem(
        Severity::kWarning,
        path,
        fmt::format("{} x {} pixels, but labels have {} x {}: ROS tools will place it wrongly",
                    size->columns,
                    size->rows,
                    labels.columns,
                    labels.rows),
        "draw it anew with `semview map occupancy`"));
  }
}

/// The drawing with outside as entry 0, then every class that has a colour; `ids[i]` is the class
/// of entry i.
struct Palette {
  std::vector<PaletteEntry> entries;
  std::vector<ClassId> ids;
};

Palette palette_of(const MapFile& file) {
  Palette palette{{{file.outside, "outside"}}, {kNoHit}};
  for (std::size_t i = 0; i < file.classes.size(); ++i) {
    const MapClass& value = file.classes[i].value;
    if (!value.color) continue;
    palette.entries.push_back({*value.color, value.name});
    palette.ids.push_back(static_cast<ClassId>(i + 1));
  }
  return palette;
}

/// The colours alone, or nothing if a pixel is transparent: what shows there is not said.
std::optional<RgbImage> opaque_colors(const Image<io::Rgba>& pixels,
                                      const Path& path,
                                      MapReport& report) {
  RgbImage colors(pixels.rows(), pixels.columns());
  std::optional<PixelIndex> first;
  std::size_t transparent = 0;
  for (int row = 0; row < pixels.rows(); ++row) {
    for (int column = 0; column < pixels.columns(); ++column) {
      const io::Rgba pixel = pixels.at(row, column);
      colors.at(row, column) = {pixel.r, pixel.g, pixel.b};
      if (pixel.a == 255) continue;
      ++transparent;
      if (!first) first = PixelIndex{row, column};
    }
  }
  if (!first) return colors;
  MapProblem problem =
      file_problem(Severity::kError,
                   path,
                   transparent == 1 ? std::string("1 pixel is transparent")
                                    : fmt::format("{} pixels are transparent", transparent),
                   "every pixel has an opaque colour; export without an alpha channel");
  problem.pixel = first;
  report.problems.push_back(std::move(problem));
  return std::nullopt;
}

/// The label image, or nothing and the reason in the report.
std::optional<RgbImage> read_labels(const MapFile& file, const Path& path, MapReport& report) {
  const Result<io::PngSize> size = io::png_size(path);
  if (!size) {
    MapProblem problem = problem_of(path, size.error());
    if (problem.code == ErrorCode::kNotFound) {
      problem.remedy = "draw the plan as a PNG there, or write its name as `labels:`";
    }
    report.problems.push_back(std::move(problem));
    return std::nullopt;
  }
  check_size(file, path, *size, report);
  check_occupancy(file, *size, report);
  const Result<io::RgbaPicture> picture = io::read_png_rgba(path);
  if (!picture) {
    report.problems.push_back(problem_of(path, picture.error()));
    return std::nullopt;
  }
  return opaque_colors(picture->pixels, path, report);
}

Path objects_path(const MapFile& file) { return file.path.parent_path() / file.objects.text; }

/// Columns of the drawing alone: one profile an entry of the palette.
ColumnMap columns_of(const MapFile& file,
                     const SemanticMap& map,
                     const Storey& storey,
                     const Palette& palette,
                     Image<std::uint8_t> pixels) {
  ColumnMap columns;
  columns.profile_of_pixel = std::move(pixels);
  columns.resolution_m = file.resolution_m;
  columns.origin = file.origin;
  columns.ground_height_m = storey.ground_height_m;
  columns.ceiling = storey.ceiling;
  columns.profiles.push_back(ColumnProfile{true, false, kNoHit, {}});
  for (std::size_t i = 1; i < palette.ids.size(); ++i) {
    columns.profiles.push_back(
        column_profile(map.class_details, map.classes, palette.ids[i], storey));
  }
  return columns;
}

/// Marks what the drawing has of each class, and what objects add.
void check_drawn(const MapFile& file,
                 const Palette& palette,
                 const Image<std::uint8_t>& pixels,
                 const std::vector<ObjectClass>& objects,
                 MapReport& report) {
  std::vector<bool> seen(palette.ids.size(), false);
  for (const std::uint8_t index : pixels.pixels()) seen[index] = true;
  std::vector<bool> drawn(file.classes.size(), false);
  for (std::size_t i = 1; i < seen.size(); ++i) drawn[palette.ids[i] - 1U] = seen[i];
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::string& name = file.classes[i].value.name;
    for (const auto& [object, own] : objects) {
      if (own.name == name || own.above == name || own.below == name) drawn[i] = true;
    }
  }
  check_unused(file, drawn, report);
}

/// Sets the geometry of `map` and what belongs to it; false and the reason in the report if there
/// is none.
bool read_columns(const MapFile& file,
                  const LoadOptions& options,
                  MapReport& report,
                  SemanticMap& map) {
  std::vector<MapObject> features;
  if (!file.objects.text.empty()) features = read_objects(objects_path(file), report);
  const std::size_t feature_count = features.size();
  std::vector<ObjectClass> objects;
  if (file.has_classes) {
    objects = check_objects(std::move(features), objects_path(file), file, report);
  }
  if (file.labels.text.empty()) return false;
  const Path path = file.path.parent_path() / file.labels.text;
  const std::optional<RgbImage> labels = read_labels(file, path, report);
  const bool complete = file.has_classes && file.all_coloured &&
                        file.classes.size() <= static_cast<std::size_t>(kMaxClasses);
  if (!labels || !complete) return false;
  const Palette palette = palette_of(file);
  std::optional<Image<std::uint8_t>> pixels =
      match_colors(*labels, palette.entries, options.nearest_colour, path, report);
  if (!pixels || report.has_errors()) return false;
  check_drawn(file, palette, *pixels, objects, report);

  map = map_of(file);
  map.drawing = path;
  const Storey storey = storey_of(file, map.classes);
  ColumnMap columns = columns_of(file, map, storey, palette, *std::move(pixels));
  if (!file.objects.text.empty()) {
    map.objects.features = feature_count;
    map.objects.profiles =
        draw_objects(objects,
                     objects_path(file),
                     {columns, palette.ids, map.class_details, map.classes, storey},
                     report);
  }
  map.geometry = std::move(columns);
  return true;
}

std::optional<SemanticMap> read_bundle(const Path& path,
                                       const LoadOptions& options,
                                       MapReport& report) {
  const std::optional<MapFile> file = read_map_file(path, report);
  if (!file) return std::nullopt;
  if (file->has_classes) check_classes(*file, report);
  SemanticMap map;
  if (file->is_mesh()) {
    std::optional<MeshGeometry> mesh = read_mesh(*file, report);
    if (!mesh) return std::nullopt;
    map = map_of(*file);
    map.geometry = *std::move(mesh);
    if (!file->volume.text.empty()) map.volume = file->path.parent_path() / file->volume.text;
  } else {
    if (!read_columns(*file, options, report, map)) return std::nullopt;
  }
  if (report.has_errors()) return std::nullopt;
  return map;
}

/// The map of a semantic volume: that of the map.yaml beside it.
std::optional<SemanticMap> read_volume_bundle(const Path& volume,
                                              const LoadOptions& options,
                                              MapReport& report) {
  const Path bundle = volume.parent_path() / "map.yaml";
  std::error_code ignored;
  if (std::filesystem::exists(bundle, ignored)) {
    std::optional<SemanticMap> map = read_bundle(bundle, options, report);
    if (!map || map->volume.filename() == volume.filename()) return map;
  }
  report.problems.push_back(
      file_problem(Severity::kError,
                   volume,
                   "no map.yaml beside it names it as `volume:`",
                   "`semview fuse` writes one when all frames are in; the same command goes on"));
  return std::nullopt;
}

}  // namespace

std::optional<SemanticMap> read_map(const Path& path,
                                    const LoadOptions& options,
                                    MapReport& report) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    MapProblem problem = file_problem(Severity::kError,
                                      path,
                                      "no such file or folder",
                                      "a map is a folder with a map.yaml, that file, or a .glb");
    problem.code = ErrorCode::kNotFound;
    report.problems.push_back(std::move(problem));
    return std::nullopt;
  }
  try {
    std::optional<SemanticMap> map;
    if (std::filesystem::is_directory(path, ignored)) {
      map = read_bundle(path / "map.yaml", options, report);
    } else if (path.extension() == ".glb") {
      map = read_bare_glb(path, report);
    } else if (path.extension() == ".vdb") {
      map = read_volume_bundle(path, options, report);
    } else {
      map = read_bundle(path, options, report);
    }
    if (map) map->fingerprint = fingerprint_of(*map);
    return map;
  } catch (const std::bad_alloc&) {
    MapProblem problem =
        file_problem(Severity::kError, path, "the map does not fit into this machine's memory");
    problem.code = ErrorCode::kResourceExhausted;
    report.problems.push_back(std::move(problem));
    return std::nullopt;
  }
}

}  // namespace semview::map::detail

namespace semview::map {

Result<SemanticMap> load_map(const std::filesystem::path& path, const LoadOptions& options) {
  MapReport report;
  std::optional<SemanticMap> map = detail::read_map(path, options, report);
  if (!map) return fail(first_error(report));
  return *std::move(map);
}

}  // namespace semview::map
