// SPDX-License-Identifier: Apache-2.0
/// `semview map distort` and `semview map rectify`.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "map_verbs.hpp"
#include "semview/geometry/affine.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/distorted_bundle.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

constexpr std::size_t kMaxAffineFileBytes = std::size_t{16} << 20U;

struct Options {
  std::string map;
  std::string output;
  std::string scale;
  double shear = 0.0;
  std::string affine;
  map::LoadOptions load;
  bool json = false;
};

Status write(const Options& options, const MapAffine& affine) {
  SEMVIEW_TRY_STATUS(io::check_output_folder(options.output));
  SEMVIEW_TRY_STATUS(map::write_distorted(options.map, affine, options.output, options.load));
  if (options.json) {
    const nlohmann::ordered_json json{{"map", options.output},
                                      {"moved_by", {{affine.a, 0.0}, {affine.k, affine.b}}}};
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{}: written, every point moved by [[{:g}, 0], [{:g}, {:g}]]\n",
             options.output,
             affine.a,
             affine.k,
             affine.b);
  return {};
}

Status distort(const Options& options) {
  MapAffine affine;
  if (!options.scale.empty()) {
    SEMVIEW_TRY(const std::vector<double> scale, parse_numbers("--scale", options.scale, 2));
    affine.a = scale[0];
    affine.b = scale[1];
  }
  affine.k = options.shear;
  if (affine.is_identity()) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      "nothing to distort: give --scale SX,SY, --shear K or both",
                      "--scale"});
  }
  if (!affine.in_range()) {
    const char* const option = options.scale.empty() ? "--shear" : "--scale";
    return fail(
        Error{ErrorCode::kInvalidArgument,
              fmt::format("{}: scale {}, {} and shear {}: expected scales of 0.2 to 5 and a "
                          "shear of -2 to 2",
                          option,
                          affine.a,
                          affine.b,
                          affine.k),
              option});
  }
  return write(options, affine);
}

/// Where `semview localize --json` says how the map is drawn.
const nlohmann::json::json_pointer kMapOfLast("/last/map");

std::optional<MapAffine> find_affine(const nlohmann::json& json) {
  const auto number = [&json](const char* key) -> std::optional<double> {
    const auto at = kMapOfLast / key;
    if (!json.contains(at) || !json.at(at).is_number()) return {};
    return json.at(at).get<double>();
  };
  const auto a = number("scale_x");
  const auto b = number("scale_y");
  const auto k = number("shear");
  if (!a || !b || !k) return {};
  return MapAffine{*a, *b, *k};
}

Result<MapAffine> read_affine(const std::string& text) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(text, ignored)) {
    const auto numbers_given = parse_numbers("--affine", text, 3);
    if (!numbers_given) {
      return fail(
          Error{ErrorCode::kInvalidArgument,
                fmt::format("--affine {}: is no file there, nor three numbers SX,SY,K", text),
                "--affine"});
    }
    const std::vector<double>& numbers = *numbers_given;
    return MapAffine{numbers[0], numbers[1], numbers[2]};
  }
  SEMVIEW_TRY(const std::string content, io::read_text_file(text, kMaxAffineFileBytes));
  const nlohmann::json json = nlohmann::json::parse(content, nullptr, false);
  const std::optional<MapAffine> affine = json.is_discarded() ? std::nullopt : find_affine(json);
  if (affine) return *affine;
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("{}: {}, expected the JSON of `semview localize --json "
                                "--estimate-map-affine` with scale_x, scale_y and shear in "
                                "last.map",
                                text,
                                json.is_discarded() ? "is not JSON" : "does not say them"),
                    "--affine"});
}

Status rectify(const Options& options) {
  SEMVIEW_TRY(const MapAffine affine, read_affine(options.affine));
  if (affine.a == 0.0 || affine.b == 0.0) {
    return fail(
        Error{ErrorCode::kInvalidArgument, "--affine: scales of 0 cannot be undone", "--affine"});
  }
  return write(options, inverse(affine));
}

void add_common(CLI::App& verb, Options& options) {
  verb.add_option("MAP", options.map, "Map folder or map.yaml of a drawn plan")->required();
  verb.add_option("-o,--output", options.output, "Folder to make")->type_name("DIR")->required();
  add_nearest_colour(verb, options.load);
  verb.add_flag("--json", options.json, "Print JSON: the folder and how points were moved");
}

}  // namespace

void add_map_distort(CLI::App& map, int& exit_code) {
  CLI::App* distort_verb = map.add_subcommand(
      "distort",
      "Write a copy of a drawn map that is out of scale or oblique, as hand-drawn plans are: x "
      "becomes SX x, y becomes SY y + K x (frame map); heights stay. Everything in the folder is "
      "kept.");
  const auto distorted = std::make_shared<Options>();
  add_common(*distort_verb, *distorted);
  distort_verb->add_option("--scale", distorted->scale, "Scales of x and y, 0.2 to 5")
      ->type_name("SX,SY");
  distort_verb
      ->add_option("--shear", distorted->shear, "y grows by this much a metre of x, -2 to 2")
      ->type_name("K");
  distort_verb->footer("Example: semview map distort maps/tutorial --scale 1.2,0.83 -o sketch");
  distort_verb->callback([distorted, &exit_code] { exit_code = report(distort(*distorted)); });

  CLI::App* rectify_verb = map.add_subcommand(
      "rectify",
      "Write a copy of a drawn map with a distortion undone: the way back from `map distort`, or "
      "the map as a robot found it to be (`semview localize --estimate-map-affine --json`).");
  const auto rectified = std::make_shared<Options>();
  add_common(*rectify_verb, *rectified);
  rectify_verb
      ->add_option("--affine",
                   rectified->affine,
                   "How the plan is drawn: scales of x and y and shear, or that JSON")
      ->type_name("A,B,K|FILE.json")
      ->required();
  rectify_verb->footer("Example: semview map rectify sketch --affine 1.2,0.83,0 -o straight");
  rectify_verb->callback([rectified, &exit_code] { exit_code = report(rectify(*rectified)); });
}

}  // namespace semview::cli
