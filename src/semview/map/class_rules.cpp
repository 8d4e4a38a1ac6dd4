// SPDX-License-Identifier: Apache-2.0
#include "semview/map/class_rules.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/map/map_limits.hpp"
#include "semview/map/spelling.hpp"

namespace semview::map::detail {
namespace {

class ClassRules {
 public:
  ClassRules(const MapFile& file, MapReport& report) : file_(file), report_(report) {
    for (const ClassField& field : file.classes) by_name_.emplace(field.value.name, &field);
  }

  void check() {
    if (file_.classes.size() > static_cast<std::size_t>(kMaxClasses)) {
      error(file_.classes[kMaxClasses].line,
            fmt::format("{} classes are too many", file_.classes.size()),
            fmt::format("a map has at most {}", kMaxClasses));
    }
    check_names();
    check_level(file_.ground, "ground");
    if (file_.ceiling) check_level(*file_.ceiling, "ceiling");
    if (!ceiling_is_above_ground()) {
      add(Severity::kError,
          file_.path,
          file_.ceiling->line,
          fmt::format("ceiling height {} is not above the ground's height {}",
                      file_.ceiling->height_m,
                      file_.ground.height_m),
          "heights are z in frame map, in metres");
    }
    check_colors();
    if (file_.is_mesh()) return;
    for (const ClassField& field : file_.classes) {
      check_heights(field);
      check_reference(field, "above", field.value.above, field.above_line);
      check_reference(field, "below", field.value.below, field.below_line);
    }
  }

 private:
  /// Heights that could not be read are no ground for more complaints.
  bool knows_ground() const { return file_.is_mesh() || file_.ground.has_height; }
  bool ceiling_is_above_ground() const {
    return !file_.ceiling || !file_.ceiling->has_height || !knows_ground() ||
           file_.ceiling->height_m > file_.ground.height_m;
  }

  void check_names() {
    std::map<std::string, int> lines;
    for (const ClassField& field : file_.classes) {
      const std::string& name = field.value.name;
      if (name.empty()) continue;  // said by the reader
      const auto [first, is_new] = lines.emplace(name, field.line);
      if (!is_new) {
        error(field.line,
              fmt::format("class {} is listed twice (first in line {})", name, first->second),
              "names are unique");
      }
      const bool odd = std::any_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == ',' || c == '"';
      });
      if (odd || name.size() > kMaxClassNameLength) {
        error(field.line,
              fmt::format("class name {} is not usable", name),
              fmt::format("at most {} bytes without commas, quotes and control characters",
                          kMaxClassNameLength));
      }
      if (name == "none" || name == "unknown") {
        error(field.line,
              fmt::format("class name {} is reserved", name),
              "it stands for what a ray or a camera did not meet");
      }
    }
  }

  void check_colors() {
    std::map<Rgb, const ClassField*> owners;
    for (const ClassField& field : file_.classes) {
      if (!field.value.color) continue;
      const Rgb color = *field.value.color;
      if (!file_.is_mesh() && color == file_.outside) {
        error(field.color_line,
              fmt::format("class {} has the colour of outside, [{}, {}, {}]",
                          field.value.name,
                          color.r,
                          color.g,
                          color.b),
              file_.outside_line > 0 ? "" : "outside is black unless the file says otherwise");
      }
      const auto [owner, is_new] = owners.emplace(color, &field);
      if (is_new) continue;
      error(field.color_line,
            fmt::format("class {} has the colour of class {}, [{}, {}, {}]",
                        field.value.name,
                        owner->second->value.name,
                        color.r,
                        color.g,
                        color.b),
            "colours are unique");
    }
  }

  void check_heights(const ClassField& field) {
    const MapClass& value = field.value;
    if (!field.has_heights) {
      if (!field.heights_refused && (value.color || field.height_line > 0)) {
        error(field.line,
              fmt::format("class {} lacks min_height or max_height", value.name),
              "a class that is drawn has both");
      }
      return;
    }
    const double ground_m = file_.ground.height_m;
    if (value.min_height_m > value.max_height_m) {
      error(field.height_line,
            fmt::format("min_height {} of class {} is above its max_height {}",
                        value.min_height_m,
                        value.name,
                        value.max_height_m),
            "min_height is the lower face's");
      return;
    }
    if (value.min_height_m == value.max_height_m) {
      if (value.min_height_m == ground_m || !knows_ground()) return;
      error(
          field.height_line,
          fmt::format(
              "class {} has no thickness: both its heights are {}", value.name, value.min_height_m),
          fmt::format("only paint on the ground has none, with both heights at the ground's, {}",
                      ground_m));
      return;
    }
    check_cuts(field);
  }

  void check_cuts(const ClassField& field) {
    const MapClass& value = field.value;
    const bool has_ceiling =
        file_.ceiling && file_.ceiling->has_height && ceiling_is_above_ground();
    if (has_ceiling && value.max_height_m > file_.ceiling->height_m) {
      warn(field.height_line,
           fmt::format("class {} is cut at the ceiling: max_height {} is above {}",
                       value.name,
                       value.max_height_m,
                       file_.ceiling->height_m),
           value.min_height_m >= file_.ceiling->height_m ? "nothing is left of it"
                                                         : "lower it or raise the ceiling");
    }
    if (knows_ground() && value.min_height_m < file_.ground.height_m) {
      warn(field.height_line,
           fmt::format("class {} is cut at the ground: min_height {} is below {}",
                       value.name,
                       value.min_height_m,
                       file_.ground.height_m),
           value.max_height_m <= file_.ground.height_m ? "nothing is left of it"
                                                       : "raise it or lower the ground");
    }
  }

  void check_reference(const ClassField& field,
                       std::string_view key,
                       const std::string& name,
                       int line) {
    if (name.empty()) return;
    if (name == field.value.name) {
      error(line,
            fmt::format("{} of class {} names the class itself", key, name),
            "name the class that fills what is left there, wall for example");
      return;
    }
    const auto found = by_name_.find(name);
    if (found == by_name_.end()) {
      unknown_class(
          file_.classes_path,
          line,
          name,
          fmt::format(
              "{} of class {} names class {}, which is not listed", key, field.value.name, name));
    } else if (!found->second->has_heights && !found->second->heights_refused) {
      error(line,
            fmt::format(
                "{} of class {} names class {}, which has no heights", key, field.value.name, name),
            fmt::format("give {} min_height and max_height", name));
    }
  }

  void check_level(const LevelField& level, std::string_view key) {
    if (level.class_name.line == 0 || by_name_.contains(level.class_name.text)) return;
    unknown_class(
        file_.path,
        level.class_name.line,
        level.class_name.text,
        fmt::format("{} names class {}, which is not listed", key, level.class_name.text));
  }

  void unknown_class(const std::filesystem::path& path,
                     int line,
                     const std::string& name,
                     std::string message) {
    if (!file_.all_named) return;  // it may be the one whose name could not be read
    std::vector<std::string_view> names;
    for (const ClassField& field : file_.classes) names.push_back(field.value.name);
    add(Severity::kError,
        path,
        line,
        std::move(message),
        did_you_mean(name, names) + fmt::format("listed: {}", fmt::join(names, ", ")));
  }

  void add(Severity severity,
           const std::filesystem::path& path,
           int line,
           std::string message,
           std::string remedy = {}) {
    report_.problems.push_back(
        line_problem(severity, path, line, std::move(message), std::move(remedy)));
  }
  void error(int line, std::string message, std::string remedy = {}) {
    add(Severity::kError, file_.classes_path, line, std::move(message), std::move(remedy));
  }
  void warn(int line, std::string message, std::string remedy = {}) {
    add(Severity::kWarning, file_.classes_path, line, std::move(message), std::move(remedy));
  }

  const MapFile& file_;
  MapReport& report_;
  std::map<std::string, const ClassField*> by_name_;
};

}  // namespace

void check_classes(const MapFile& file, MapReport& report) { ClassRules(file, report).check(); }

void check_unused(const MapFile& file, const std::vector<bool>& drawn, MapReport& report) {
  std::set<std::string> used{file.ground.class_name.text};
  if (file.ceiling) used.insert(file.ceiling->class_name.text);
  for (std::size_t i = 0; i < file.classes.size(); ++i) {
    if (!drawn[i]) continue;
    used.insert(
        {file.classes[i].value.name, file.classes[i].value.above, file.classes[i].value.below});
  }
  for (const ClassField& field : file.classes) {
    if (used.contains(field.value.name)) continue;
    report.problems.push_back(line_problem(Severity::kWarning,
                                           file.classes_path,
                                           field.line,
                                           fmt::format("class {} is not used", field.value.name),
                                           "nothing is drawn in it and nothing refers to it"));
  }
}

Storey storey_of(const MapFile& file, const ClassTable& table) {
  Storey storey;
  storey.ground_height_m = file.ground.height_m;
  storey.ground_label = table.id(file.ground.class_name.text).value_or(kNoHit);
  if (file.ceiling) {
    storey.ceiling =
        Ceiling{table.id(file.ceiling->class_name.text).value_or(kNoHit), file.ceiling->height_m};
  }
  return storey;
}

}  // namespace semview::map::detail
