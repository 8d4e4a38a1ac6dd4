// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/core/hash.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/range_png.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/view_picture.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/service/site.hpp"
#include "site_options.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  SiteOptions site;
  std::string pose;
  std::string pinhole;
  std::string affine;
  std::string labels_file, range_file, image_file, range_image_file;
  bool json = false;
};

/// A cast view of either camera.
struct View {
  LabelImage labels;
  RangeImage distances_m;
  std::optional<PanoramaCamera> panorama;  // none: a pinhole view, distances are depths
  double cast_ms = 0.0;
};

Result<Pose2> read_pose(const Options& options) {
  SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--pose", options.pose, 3));
  return Pose2{numbers[0], numbers[1], wrap_angle(rad_from_deg(numbers[2]))};
}

Result<MapAffine> read_affine(const Options& options) {
  if (options.affine.empty()) return MapAffine{};
  SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--affine", options.affine, 3));
  return MapAffine{numbers[0], numbers[1], numbers[2]};
}

Result<PinholeCamera> read_pinhole(const std::string& text) {
  SEMVIEW_TRY(const std::vector<double> numbers, parse_numbers("--pinhole", text, 6));
  const double columns = numbers[4];
  const double rows = numbers[5];
  const auto is_size = [](double size) {
    return size >= 1.0 && size <= raycast::kMaxPinholeRows && size == std::floor(size);
  };
  if (!is_size(columns) || !is_size(rows)) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("--pinhole {}: W and H must be whole numbers from 1 to {}",
                                  text,
                                  raycast::kMaxPinholeRows),
                      "--pinhole"});
  }
  return PinholeCamera{static_cast<int>(columns),
                       static_cast<int>(rows),
                       numbers[0],
                       numbers[1],
                       numbers[2],
                       numbers[3]};
}

/// Turns the field of a refused request into the option that set it.
template <typename T>
Result<T> name_option(Result<T> result) {
  if (result) return result;
  Error error = std::move(result).error();
  if (error.field == "eye_height_m") error.field = "eye-height";
  if (!error.field.empty() && !error.field.starts_with("--")) error.field = "--" + error.field;
  return fail(std::move(error));
}

Result<View> cast(const service::Site& site, const Options& options, const Pose2& pose) {
  const double eye_z_m = site.eye_z_m(options.site.eye_height_m);
  SEMVIEW_TRY(const MapAffine affine, read_affine(options));
  View view;
  const auto start = std::chrono::steady_clock::now();
  if (options.pinhole.empty()) {
    view.panorama = site.profile().camera;
    SEMVIEW_TRY(raycast::Panorama panorama,
                name_option(site.exact_panorama({pose, eye_z_m, *view.panorama, affine})));
    view.labels = std::move(panorama.labels);
    view.distances_m = std::move(panorama.ranges_m);
  } else {
    SEMVIEW_TRY(const PinholeCamera camera, read_pinhole(options.pinhole));
    SEMVIEW_TRY(raycast::PinholeView pinhole,
                name_option(site.exact_pinhole({level_camera(pose, eye_z_m), camera})));
    view.labels = std::move(pinhole.labels);
    view.distances_m = std::move(pinhole.depths_m);
  }
  view.cast_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return view;
}

/// What keeps the eye from seeing the map as a robot would, or an empty text.
std::string eye_trouble(const service::Site& site, const Pose2& pose) {
  const map::ColumnMap* columns = site.map().columns();
  if (columns == nullptr) {
    const auto cell = PoseGrid::cell(pose.x_m, pose.y_m);
    return cell && site.cells().has_eye(*cell) ? "" : "the eye is inside something or outside";
  }
  const ColumnProfile* profile = columns->at(pose.x_m, pose.y_m);
  if (profile == nullptr || profile->outside) return "the eye is outside the building";
  const double eye_z_m = site.eye_z_m(site.profile().eye_height_m);
  for (const Slab& slab : profile->slabs) {
    if (eye_z_m > slab.z_min_m && eye_z_m < slab.z_max_m) {
      return fmt::format("the eye is inside a {}", site.map().classes.name(slab.label));
    }
  }
  if (columns->ceiling && eye_z_m >= columns->ceiling->height_m) {
    return "the eye is above the ceiling";
  }
  return "";
}

ordered_json class_shares(const View& view, const ClassTable& classes) {
  std::array<std::size_t, 256> counts{};
  for (const ClassId label : view.labels.pixels()) ++counts[label];
  const auto pixels = static_cast<double>(view.labels.pixels().size());
  ordered_json shares = ordered_json::array();
  for (std::size_t id = 0; id < counts.size(); ++id) {
    if (counts[id] == 0) continue;
    shares.push_back({{"id", id},
                      {"name", std::string(classes.name(static_cast<ClassId>(id)))},
                      {"pixels", counts[id]},
                      {"share", static_cast<double>(counts[id]) / pixels}});
  }
  std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
    return a["pixels"].template get<std::size_t>() > b["pixels"].template get<std::size_t>();
  });
  return shares;
}

ordered_json camera_json(const View& view) {
  ordered_json camera{{"kind", view.panorama ? "panorama" : "pinhole"},
                      {"columns", view.labels.columns()},
                      {"rows", view.labels.rows()}};
  if (view.panorama) {
    camera["elevation_deg"] = {deg_from_rad(view.panorama->elevation_min_rad),
                               deg_from_rad(view.panorama->elevation_max_rad)};
  }
  return camera;
}

ordered_json summary(const service::Site& site,
                     const Options& options,
                     const Pose2& pose,
                     const View& view) {
  ordered_json result{
      {"map", site.id()},
      {"fingerprint", to_hex(site.map().fingerprint)},
      {"engine", site.engine().name},
      {"engine_reason", site.engine().reason},
      {"pose", {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"yaw_deg", deg_from_rad(pose.yaw_rad)}}},
      {"eye_z_m", site.eye_z_m(options.site.eye_height_m)},
      {"camera", camera_json(view)},
      {"cast_ms", view.cast_ms}};
  const float nearest_m = *std::ranges::min_element(view.distances_m.pixels());
  const char* const nearest = view.panorama ? "nearest_range_m" : "nearest_depth_m";
  result[nearest] = std::isfinite(nearest_m) ? ordered_json(nearest_m) : ordered_json(nullptr);
  result["classes"] = class_shares(view, site.map().classes);
  if (const std::string trouble = eye_trouble(site, pose); !trouble.empty()) {
    result["warning"] = trouble;
  }
  return result;
}

void print_text(const ordered_json& view) {
  const ordered_json& pose = view["pose"];
  fmt::print("{} from ({:g}, {:g}) at {:g}°, eye at z {:g} m: {} x {} {} by {} in {:.2f} ms\n",
             view["map"].get<std::string>(),
             pose["x_m"].get<double>(),
             pose["y_m"].get<double>(),
             pose["yaw_deg"].get<double>(),
             view["eye_z_m"].get<double>(),
             view["camera"]["columns"].get<int>(),
             view["camera"]["rows"].get<int>(),
             view["camera"]["kind"].get<std::string>(),
             view["engine"].get<std::string>(),
             view["cast_ms"].get<double>());
  for (const ordered_json& entry : view["classes"]) {
    fmt::print("{:>5}  {:<16} {:5.1f} %\n",
               entry["id"].get<int>(),
               entry["name"].get<std::string>(),
               100.0 * entry["share"].get<double>());
  }
}

Status write_files(const service::Site& site,
                   const Options& options,
                   const Pose2& pose,
                   const View& view) {
  if (!options.labels_file.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.labels_file, view.labels));
  }
  if (!options.range_file.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.range_file, io::millimetres(view.distances_m)));
  }
  picture::ViewPictureOptions picture;
  picture.title = fmt::format(
      "{}: ({:g}, {:g}) m, {:g}°", site.map().name, pose.x_m, pose.y_m, deg_from_rad(pose.yaw_rad));
  picture.axes = view.panorama;
  if (!options.image_file.empty()) {
    const ClassTable& classes = site.map().classes;
    SEMVIEW_TRY_STATUS(io::write_png(
        options.image_file,
        draw_labels(view.labels, classes, picture::ClassPalette::for_classes(classes), picture)));
  }
  if (!options.range_image_file.empty()) {
    SEMVIEW_TRY_STATUS(
        io::write_png(options.range_image_file,
                      draw_ranges(view.distances_m, view.panorama ? "range" : "depth", picture)));
  }
  return {};
}

Status show(const Options& options) {
  SEMVIEW_TRY(const Pose2 pose, read_pose(options));
  for (const std::string* file : {&options.labels_file,
                                  &options.range_file,
                                  &options.image_file,
                                  &options.range_image_file}) {
    if (!file->empty()) SEMVIEW_TRY_STATUS(io::check_output_png(*file));
  }
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(options.site));
  SEMVIEW_TRY(const View view, cast(*site, options, pose));
  SEMVIEW_TRY_STATUS(write_files(*site, options, pose, view));
  const ordered_json result = summary(*site, options, pose, view);
  if (result.contains("warning")) {
    fmt::print(stderr, "semview: warning: {}\n", result["warning"].get<std::string>());
  }
  if (options.json) {
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_text(result);
  }
  return {};
}

}  // namespace

void add_view_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "view",
      "Cast what a camera sees from a pose: a panorama all around, or a pinhole image. The pose is "
      "taken exactly, not rounded to the grid of cached views.");
  const auto options = std::make_shared<Options>();
  add_site_options(*verb, options->site);
  // A pose that is taken exactly is none of a cache's cells.
  for (const char* option : {"--cache", "--cache-limit"}) {
    verb->remove_option(verb->get_option(option));
  }
  verb->add_option("--pose", options->pose, "X,Y,YAW_DEG in metres and degrees in frame map")
      ->required();
  verb->add_option("--pinhole",
                   options->pinhole,
                   "FX,FY,CX,CY,W,H in pixels: a level pinhole camera instead of a panorama")
      ->excludes("--columns")
      ->excludes("--rows")
      ->excludes("--elevation");
  verb->add_option("--affine",
                   options->affine,
                   "A,B,K: the plan was drawn as x' = A x, y' = K x + B y of true metres; pose as "
                   "drawn, ranges true")
      ->excludes("--pinhole");
  verb->add_option("--labels", options->labels_file, "8-bit PNG of class ids; 0 = nothing hit");
  verb->add_option("--range",
                   options->range_file,
                   "16-bit PNG in mm (depth for --pinhole); 0 = nothing hit, 65535 = that or more");
  verb->add_option("--image", options->image_file, "PNG in colours with a legend");
  verb->add_option("--range-image", options->range_image_file, "PNG of ranges with a colour bar");
  verb->add_flag("--json", options->json, "Print pose, eye, cast time and class shares as JSON");
  verb->footer(
      "Example: semview view maps/duplex_level1 --pose 2,-3,90 --image view.png --range mm.png\n"
      "         semview view maps/tutorial --pose 1,1,0 --pinhole 300,300,320,240,640,480 "
      "--image photo.png");
  verb->callback([options, &exit_code] { exit_code = report(show(*options)); });
}

}  // namespace semview::cli
