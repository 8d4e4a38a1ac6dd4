// SPDX-License-Identifier: Apache-2.0
#include "semview/map/bundle_writer.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/occupancy.hpp"
#include "semview/map/semantic_map.hpp"

namespace semview::map::detail {
namespace {

constexpr std::size_t kMaxIdLetters = 64;

/// A text as YAML: bare where that is safe, else in double quotes.
std::string quoted(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool bare = !text.empty() && is_letter(text.front()) && text.back() != ' ' &&
                    std::all_of(text.begin(), text.end(), [&](char c) {
                      return is_letter(c) || (c >= '0' && c <= '9') || c == ' ' || c == '_';
                    });
  const bool word = text == "true" || text == "false" || text == "null" || text == "yes" ||
                    text == "no" || text == "on" || text == "off" || text == "y" || text == "n";
  if (bare && !word) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n' || c == '\r' || c == '\t') {
      out += ' ';
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string color_text(Rgb color) { return fmt::format("[{}, {}, {}]", color.r, color.g, color.b); }

std::string class_text(const MapClass& value) {
  std::string text = fmt::format("    - {{name: {}", quoted(value.name));
  if (value.color) {
    text += fmt::format(", color: {}, min_height: {}, max_height: {}",
                        color_text(*value.color),
                        value.min_height_m,
                        value.max_height_m);
  }
  if (!value.below.empty()) text += fmt::format(", below: {}", quoted(value.below));
  if (!value.above.empty()) text += fmt::format(", above: {}", quoted(value.above));
  if (value.passable != (value.name == "door")) {
    text += fmt::format(", passable: {}", value.passable);
  }
  if (value.movable > 0.0) text += fmt::format(", movable: {}", value.movable);
  if (!value.aliases.empty()) {
    std::vector<std::string> aliases;
    for (const std::string& alias : value.aliases) aliases.push_back(quoted(alias));
    text += fmt::format(", aliases: [{}]", fmt::join(aliases, ", "));
  }
  return text + "}\n";
}

/// `name` in the letters of an id, or "" if it is one already.
std::string id_for(const std::string& name) {
  std::string id;
  for (const char letter : name.substr(0, kMaxIdLetters)) {
    const bool upper = letter >= 'A' && letter <= 'Z';
    const bool fine = (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
                      letter == '_' || letter == '-';
    id += upper ? static_cast<char>(letter - 'A' + 'a') : fine ? letter : '_';
  }
  return id == name ? std::string() : id;
}

}  // namespace

std::string map_yaml(const BundleText& text) {
  std::string yaml = fmt::format("# {}\n", text.comment);
  yaml += "image: occupancy.png\n";
  yaml += fmt::format("resolution: {}\n", text.resolution_m);
  yaml +=
      fmt::format("origin: [{}, {}, {}]\n", text.origin.x_m, text.origin.y_m, text.origin.yaw_rad);
  yaml += "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nsemview:\n  format: 1\n";
  if (!text.id.empty()) yaml += fmt::format("  id: {}\n", quoted(text.id));
  yaml += fmt::format("  name: {}\n  labels: labels.png\n", quoted(text.name));
  if (!text.objects.empty()) yaml += "  objects: objects.geojson\n";
  if (!text.ceiling_class.empty()) {
    yaml += fmt::format("  ceiling: {{class: {}, height: {}}}\n",
                        quoted(text.ceiling_class),
                        text.ceiling_height_m);
  }
  yaml += fmt::format(
      "  ground: {{class: {}, height: {}}}\n", quoted(text.ground_class), text.ground_height_m);
  yaml += fmt::format("  outside: {}\n  classes:\n", color_text(text.outside));
  for (const MapClass& value : text.classes) yaml += class_text(value);
  return yaml;
}

Status write_bundle(const BundleText& text,
                    const RgbImage& labels,
                    const std::filesystem::path& directory) {
  const std::filesystem::path yaml = directory / "map.yaml";
  std::error_code error;
  if (std::filesystem::exists(yaml, error)) {
    return fail(ErrorCode::kAlreadyExists,
                fmt::format("{}: exists already; name another folder", yaml.string()));
  }
  SEMVIEW_TRY_STATUS(io::check_holds_nothing_else(directory, io::FolderKind::kMap));
  std::filesystem::create_directories(directory, error);
  if (error) {
    return fail(ErrorCode::kUnavailable,
                fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  }
  BundleText named = text;
  named.id = id_for(std::filesystem::absolute(directory / "").parent_path().filename().string());
  SEMVIEW_TRY_STATUS(io::write_png(directory / "labels.png", labels));
  if (!named.objects.empty()) {
    SEMVIEW_TRY_STATUS(io::write_text_file(directory / "objects.geojson", named.objects));
  }
  SEMVIEW_TRY_STATUS(io::write_text_file(yaml, map_yaml(named)));
  SEMVIEW_TRY(const SemanticMap map, load_map(directory));
  return io::write_png(directory / "occupancy.png", occupancy_image(*map.columns()));
}

}  // namespace semview::map::detail
