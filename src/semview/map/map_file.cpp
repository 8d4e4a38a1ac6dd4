// SPDX-License-Identifier: Apache-2.0
#include "semview/map/map_file.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/io/yaml_document.hpp"
#include "semview/map/map_limits.hpp"
#include "semview/map/raster_fields.hpp"
#include "semview/map/yaml_fields.hpp"

namespace semview::map::detail {
namespace {

using Path = std::filesystem::path;

std::optional<Rgb> read_color(YamlFields& fields, const io::YamlNode& node) {
  constexpr const char* kRemedy = "write for example [120, 120, 120]";
  const std::optional<std::vector<double>> numbers = fields.take(node.numbers(3), kRemedy);
  if (!numbers) return std::nullopt;
  std::vector<double> bad;
  std::ranges::copy_if(*numbers, std::back_inserter(bad), [](double number) {
    return number < 0.0 || number > 255.0 || number != std::floor(number);
  });
  if (!bad.empty()) {
    fields.error(node.line(),
                 fmt::format("colour value{} {} {} in 0..255",
                             bad.size() == 1 ? "" : "s",
                             fmt::join(bad, ", "),
                             bad.size() == 1 ? "is not a whole number" : "are not whole numbers"),
                 kRemedy);
    return std::nullopt;
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>((*numbers)[i]); };
  return Rgb{byte(0), byte(1), byte(2)};
}

std::optional<double> read_height(YamlFields& fields, std::string_view key, Need need) {
  const std::optional<double> height_m = fields.number(key, need, fmt::format("{}: 0.0", key));
  if (height_m && std::abs(*height_m) > kMaxHeight_m) {
    fields.error(fields.line_of(key),
                 fmt::format("{} {} m is out of limits", key, *height_m),
                 fmt::format("heights lie within {} m of 0", kMaxHeight_m));
    return std::nullopt;
  }
  return height_m;
}

/// A map is a folder that can be copied and served as it is: what it is made of lies in it.
bool stays_inside(YamlFields& fields, std::string_view key, const std::string& name) {
  const Path path = Path(name).lexically_normal();
  if (!name.empty() && path.is_relative() && *path.begin() != "..") return true;
  fields.error(fields.line_of(key),
               name.empty() ? fmt::format("{} is empty", key)
                            : fmt::format("{} {} is not in the map's folder", key, name),
               "put the file beside map.yaml and write its name");
  return false;
}

TextField read_text(YamlFields& fields, std::string_view key, Need need, std::string_view example) {
  const std::optional<std::string> text = fields.text(key, need, example);
  return text ? TextField{*text, fields.line_of(key)} : TextField{};
}

void read_identity(MapFile& file, YamlFields& fields) {
  const std::optional<std::string> id = fields.text("id", Need::kOptional);
  const Path folder = std::filesystem::absolute(file.path).lexically_normal().parent_path();
  file.id = id ? *id : folder.filename().string();
  if (!is_map_id(file.id)) {
    fields.error(
        id ? fields.line_of("id") : fields.line(),
        fmt::format(
            "id {}{} is not an id", file.id, id ? "" : " (the folder's name, since none is given)"),
        fmt::format("an id is 1 to {} of a-z, 0-9, _ and -", kMaxMapIdLength));
  }
  file.name = fields.text("name", Need::kOptional).value_or(file.id);
}

std::optional<LevelField> read_level(YamlFields& parent,
                                     std::string_view key,
                                     Need need,
                                     Need class_need,
                                     const MapFile& file,
                                     MapReport& report) {
  const std::string example = fmt::format("{}: {{class: {}, height: {}}}",
                                          key,
                                          key == "ground" ? "floor" : "ceiling",
                                          key == "ground" ? "0.0" : "2.6");
  const std::optional<io::YamlNode> node = parent.node(key, need, example);
  if (!node) return std::nullopt;
  if (!node->is_mapping()) {
    parent.error(node->line(), fmt::format("{} is not a mapping", key), "write `" + example + "`");
    return std::nullopt;
  }
  YamlFields fields(*node, file.path, report);
  fields.expect_keys({"class", "height"});
  LevelField level;
  level.line = node->line();
  level.class_name = read_text(fields, "class", class_need, example);
  const std::optional<double> height_m = read_height(fields, "height", Need::kRequired);
  level.height_m = height_m.value_or(0.0);
  level.has_height = height_m.has_value();
  return level;
}

/// Both heights of a class, or what is known of why they are not there.
void read_heights(ClassField& field, YamlFields& fields) {
  const std::optional<double> low_m = read_height(fields, "min_height", Need::kOptional);
  const std::optional<double> high_m = read_height(fields, "max_height", Need::kOptional);
  field.value.min_height_m = low_m.value_or(0.0);
  field.value.max_height_m = high_m.value_or(0.0);
  field.has_heights = low_m && high_m;
  const auto refused = [&](const char* key, const std::optional<double>& height_m) {
    return !height_m && (fields.line_of(key) > 0 || fields.misspelt(key));
  };
  field.heights_refused = refused("min_height", low_m) || refused("max_height", high_m);
  field.height_line = std::max(fields.line_of("min_height"), fields.line_of("max_height"));
}

/// The name of a class; empty if there is none, as the report says then.
std::string read_name(YamlFields& fields) {
  const std::optional<std::string> name = fields.text("name", Need::kRequired, "name: wall");
  if (!name || name->find_first_not_of(" \t\r\n") != std::string::npos) return name.value_or("");
  fields.error(
      fields.line_of("name"), "the name of a class is blank", "write for example `name: wall`");
  return {};
}

/// An entry of the class list; notes in `file` what is not known of it.
std::optional<ClassField> read_class(const io::YamlNode& node, MapFile& file, MapReport& report) {
  YamlFields fields(node, file.classes_path, report);
  if (!node.is_mapping()) {
    file.all_named = false;
    file.all_coloured = false;
    fields.error(node.line(),
                 "a class is not a mapping",
                 "write for example `- {name: wall, color: [120, 120, 120], min_height: 0.0, "
                 "max_height: 2.6}`");
    return std::nullopt;
  }
  fields.expect_keys({"name",
                      "color",
                      "min_height",
                      "max_height",
                      "above",
                      "below",
                      "passable",
                      "movable",
                      "aliases"});
  ClassField field;
  field.line = node.line();
  field.color_line = fields.line_of("color");
  field.above_line = fields.line_of("above");
  field.below_line = fields.line_of("below");
  MapClass& value = field.value;
  value.name = read_name(fields);
  file.all_named = file.all_named && !value.name.empty();
  if (const auto color = fields.node("color", Need::kOptional)) {
    value.color = read_color(fields, *color);
    file.all_coloured = file.all_coloured && value.color;
  }
  file.all_coloured = file.all_coloured && !fields.misspelt("color");
  read_heights(field, fields);
  value.above = fields.text("above", Need::kOptional).value_or("");
  value.below = fields.text("below", Need::kOptional).value_or("");
  value.passable = fields.boolean("passable").value_or(value.name == "door");
  value.movable = fields.number("movable", Need::kOptional, "movable: 0.5").value_or(0.0);
  if (!(value.movable >= 0.0 && value.movable <= 1.0)) {
    fields.error(fields.line_of("movable"),
                 fmt::format("movable {} of class {} is not in 0..1", value.movable, value.name),
                 "it is the probability that it stands elsewhere");
  }
  if (const auto aliases = fields.node("aliases", Need::kOptional)) {
    value.aliases = fields.take(aliases->texts()).value_or(std::vector<std::string>{});
  }
  return field;
}

void read_classes(MapFile& file, YamlFields& fields, MapReport& report) {
  file.classes_path = file.path;
  std::optional<io::YamlNode> list =
      fields.node("classes", Need::kRequired, "classes: [{name: wall, ...}]");
  if (list && list->is_scalar()) {
    const std::optional<std::string> name = fields.take(list->text());
    if (!name) return;
    if (!stays_inside(fields, "classes", *name)) return;
    file.classes_path = file.path.parent_path() / *name;
    Result<io::YamlNode> document = io::read_yaml(file.classes_path);
    if (!document) {
      report.problems.push_back(problem_of(file.classes_path, document.error()));
      return;
    }
    list = *document;
  }
  if (!list) return;
  if (!list->is_sequence() || list->items().empty()) {
    report.problems.push_back(line_problem(Severity::kError,
                                           file.classes_path,
                                           list->line(),
                                           "classes is not a list of classes",
                                           "write a list, or the name of a file that holds one"));
    return;
  }
  file.has_classes = true;
  for (const io::YamlNode& item : list->items()) {
    const std::optional<ClassField> field = read_class(item, file, report);
    if (field) file.classes.push_back(*field);
  }
}

void read_geometry_kind(MapFile& file, YamlFields& fields) {
  file.labels = read_text(fields, "labels", Need::kOptional, {});
  file.mesh = read_text(fields, "mesh", Need::kOptional, {});
  if (file.labels.line > 0 && !stays_inside(fields, "labels", file.labels.text)) {
    file.labels.text.clear();
  }
  if (file.mesh.line > 0 && !stays_inside(fields, "mesh", file.mesh.text)) file.mesh.text.clear();
  file.objects = read_text(fields, "objects", Need::kOptional, {});
  if (file.objects.line > 0 && !stays_inside(fields, "objects", file.objects.text)) {
    file.objects.text.clear();
  }
  if (file.objects.line > 0 && file.is_mesh()) {
    fields.error(file.objects.line,
                 "objects are given for a mesh",
                 "they belong to a drawing; a mesh has its heights already");
  }
  file.volume = read_text(fields, "volume", Need::kOptional, {});
  if (file.volume.line > 0 && !stays_inside(fields, "volume", file.volume.text)) {
    file.volume.text.clear();
  }
  const bool refused = fields.line_of("labels") > 0 || fields.misspelt("labels") ||
                       fields.line_of("mesh") > 0 || fields.misspelt("mesh");
  if (file.labels.line == 0 && file.mesh.line == 0 && refused) return;
  if ((file.labels.line > 0) == (file.mesh.line > 0)) {
    fields.error(
        fields.line(),
        file.mesh.line > 0 ? "both labels and mesh are given" : "neither labels nor mesh is given",
        "a drawn map has `labels: labels.png`, a mesh map `mesh: file.glb`");
  }
}

void read_format(YamlFields& fields, const MapFile& file, MapReport& report) {
  const auto node = fields.node("format", Need::kRequired, "format: 1");
  const auto format = node ? fields.take(node->integer(), "write `format: 1`") : std::nullopt;
  if (!format || *format == kMapFormat) return;
  MapProblem problem = line_problem(Severity::kError,
                                    file.path,
                                    node->line(),
                                    fmt::format("format {} is not known", *format),
                                    fmt::format("this version reads format {}", kMapFormat));
  problem.code = ErrorCode::kUnimplemented;
  report.problems.push_back(std::move(problem));
}

}  // namespace

std::optional<MapFile> read_map_file(const Path& path, MapReport& report) {
  const Result<io::YamlNode> document = io::read_yaml(path);
  if (!document) {
    report.problems.push_back(problem_of(path, document.error()));
    return std::nullopt;
  }
  YamlFields root(*document, path, report);
  const std::optional<io::YamlNode> block = document->find("semview");
  if (!block || !block->is_mapping()) {
    root.error(block ? block->line() : 0,
               "there is no block `semview:`",
               "a plain ROS map becomes one by `semview map import ros`");
    return std::nullopt;
  }
  MapFile file;
  file.path = path;
  YamlFields fields(*block, path, report);
  fields.expect_keys({"format",
                      "id",
                      "name",
                      "labels",
                      "mesh",
                      "objects",
                      "volume",
                      "ceiling",
                      "ground",
                      "outside",
                      "classes"});
  read_format(fields, file, report);
  read_identity(file, fields);
  read_geometry_kind(file, fields);
  const Need drawn = file.is_mesh() ? Need::kOptional : Need::kRequired;
  if (!file.is_mesh()) read_raster(file, root);
  file.ground = read_level(fields, "ground", drawn, drawn, file, report).value_or(LevelField{});
  file.ceiling = read_level(fields, "ceiling", Need::kOptional, Need::kRequired, file, report);
  if (const auto outside = fields.node("outside", Need::kOptional)) {
    file.outside_line = outside->line();
    const std::optional<Rgb> color = read_color(fields, *outside);
    file.outside = color.value_or(Rgb{});
    file.all_coloured = file.all_coloured && color;
  }
  file.all_coloured = file.all_coloured && !fields.misspelt("outside");
  read_classes(file, fields, report);
  return file;
}

}  // namespace semview::map::detail
