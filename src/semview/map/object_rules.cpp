// SPDX-License-Identifier: Apache-2.0
#include "semview/map/object_rules.hpp"

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "semview/map/spelling.hpp"

namespace semview::map::detail {
namespace {

class ObjectRules {
 public:
  ObjectRules(const std::filesystem::path& path, const MapFile& file, MapReport& report)
      : path_(path), file_(file), report_(report) {
    for (const ClassField& field : file.classes) by_name_.emplace(field.value.name, &field);
  }

  std::optional<ObjectClass> check(MapObject object) {
    feature_ = object.feature;
    refused_ = false;
    const ClassField* field = listed("class", object.class_name);
    for (const std::string& name : object.over) listed("over", name);
    if (field == nullptr) return std::nullopt;
    if (!field->value.color || !field->has_heights) {
      // The list's own mistakes are said in its place.
      const bool said = field->heights_refused || (field->value.color && !field->has_heights) ||
                        !file_.all_coloured;
      if (!said) {
        error(fmt::format("class {} has no colour and heights", field->value.name),
              "give it both in the class list: pictures of the plan show it");
      }
      return std::nullopt;
    }
    ObjectClass made{std::move(object), field->value};
    MapClass& own = made.own;
    own.min_height_m = made.object.min_height_m.value_or(own.min_height_m);
    own.max_height_m = made.object.max_height_m.value_or(own.max_height_m);
    own.above = made.object.above.value_or(own.above);
    own.below = made.object.below.value_or(own.below);
    check_heights(own);
    if (made.object.above) check_reference("above", own, own.above);
    if (made.object.below) check_reference("below", own, own.below);
    return refused_ ? std::nullopt : std::optional(std::move(made));
  }

 private:
  const ClassField* listed(std::string_view key, const std::string& name) {
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) return found->second;
    refused_ = true;
    if (!file_.all_named) return nullptr;  // it may be the one whose name could not be read
    std::vector<std::string_view> names;
    for (const ClassField& field : file_.classes) names.push_back(field.value.name);
    error(fmt::format("{} {} is not listed", key, name),
          did_you_mean(name, names) + fmt::format("listed: {}", fmt::join(names, ", ")));
    return nullptr;
  }

  void check_heights(const MapClass& own) {
    const double ground_m = file_.ground.height_m;
    const std::string what =
        fmt::format("{} of {} to {} m", own.name, own.min_height_m, own.max_height_m);
    if (own.min_height_m > own.max_height_m) {
      error(fmt::format("min_height {} is above max_height {}", own.min_height_m, own.max_height_m),
            "min_height is the lower face's; what is absent is the class's own");
      return;
    }
    if (!file_.ground.has_height) return;
    if (own.min_height_m == own.max_height_m) {
      if (own.min_height_m == ground_m) return;
      error(what + " has no thickness",
            fmt::format("only paint on the ground has none, with both heights at the ground's, {}",
                        ground_m));
      return;
    }
    if (own.min_height_m < ground_m) {
      warn(what + fmt::format(" is cut at the ground, {}", ground_m), "heights are z in frame map");
    }
    if (file_.ceiling && file_.ceiling->has_height && own.max_height_m > file_.ceiling->height_m) {
      warn(what + fmt::format(" is cut at the ceiling, {}", file_.ceiling->height_m),
           "heights are z in frame map");
    }
  }

  void check_reference(std::string_view key, const MapClass& own, const std::string& name) {
    if (name.empty()) return;
    if (name == own.name) {
      error(fmt::format("{} names the class itself, {}", key, name),
            "name the class that fills what is left there, or none");
      return;
    }
    const ClassField* field = listed(key, name);
    if (field == nullptr || field->has_heights || field->heights_refused) return;
    error(fmt::format("{} names class {}, which has no heights", key, name),
          fmt::format("give {} min_height and max_height in the class list", name));
  }

  void add(Severity severity, std::string message, std::string remedy) {
    MapProblem problem = file_problem(severity, path_, std::move(message), std::move(remedy));
    problem.feature = feature_;
    report_.problems.push_back(std::move(problem));
  }
  void error(std::string message, std::string remedy) {
    refused_ = true;
    add(Severity::kError, std::move(message), std::move(remedy));
  }
  void warn(std::string message, std::string remedy) {
    add(Severity::kWarning, std::move(message), std::move(remedy));
  }

  const std::filesystem::path& path_;
  const MapFile& file_;
  MapReport& report_;
  std::map<std::string, const ClassField*> by_name_;
  Feature feature_;
  bool refused_ = false;
};

}  // namespace

std::vector<ObjectClass> check_objects(std::vector<MapObject> objects,
                                       const std::filesystem::path& path,
                                       const MapFile& file,
                                       MapReport& report) {
  ObjectRules rules(path, file, report);
  std::vector<ObjectClass> checked;
  for (MapObject& object : objects) {
    if (std::optional<ObjectClass> made = rules.check(std::move(object))) {
      checked.push_back(*std::move(made));
    }
  }
  return checked;
}

}  // namespace semview::map::detail
