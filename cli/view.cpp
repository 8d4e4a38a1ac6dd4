// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/lib/remote_exact_view.hpp"
#include "client/lib/remote_maps.hpp"
#include "semview/geometry/angle.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/io/range_png.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/shaded_picture.hpp"
#include "semview/picture/view_picture.hpp"
#include "semview/raycast/columns_engine.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/service/site.hpp"
#include "server_option.hpp"
#include "site_options.hpp"
#include "verb.hpp"
#include "view_summary.hpp"

namespace semview::cli {
namespace {

struct Options {
  SiteOptions site;
  std::string server;  ///< empty: in this process
  std::string pose;
  std::string pinhole;
  std::string affine;
  std::string labels_file, range_file, image_file, range_image_file, photo_file;
  bool json = false;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

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

/// A view, and of what.
struct Seen {
  ViewedMap map;
  View view;
};

Result<Seen> see_here(const Options& options, const Pose2& pose) {
  SEMVIEW_TRY(const std::shared_ptr<service::Site> site, open_site(options.site));
  const double eye_z_m = site->eye_z_m(options.site.eye_height_m);
  SEMVIEW_TRY(const MapAffine affine, read_affine(options));
  Seen seen{viewed_map(*site, pose, eye_z_m), {}};
  View& view = seen.view;
  const auto start = std::chrono::steady_clock::now();
  if (options.pinhole.empty()) {
    view.panorama = site->profile().camera;
    const raycast::PanoramaRequest request{pose, eye_z_m, *view.panorama, affine};
    SEMVIEW_TRY(raycast::Panorama panorama, name_option(site->exact_panorama(request)));
    view.engine = site->panorama_engine(request);
    view.labels = std::move(panorama.labels);
    view.distances_m = std::move(panorama.ranges_m);
  } else {
    SEMVIEW_TRY(const PinholeCamera camera, read_pinhole(options.pinhole));
    if (options.site.engine == raycast::ColumnsEngine::kName) {
      return fail(Error{ErrorCode::kInvalidArgument,
                        "--engine columns: casts panoramas only; a pinhole image takes --engine "
                        "embree or auto",
                        "--engine"});
    }
    SEMVIEW_TRY(raycast::PinholeView pinhole,
                name_option(site->exact_pinhole({level_camera(pose, eye_z_m), camera})));
    view.engine = site->pinhole_engine();
    view.labels = std::move(pinhole.labels);
    view.distances_m = std::move(pinhole.depths_m);
  }
  view.cast_ms = milliseconds_since(start);
  return seen;
}

/// The same by a server. Camera and eye height are this command's, whatever views the server keeps.
Result<Seen> see_there(const Options& options, const Pose2& pose) {
  SEMVIEW_TRY(const service::SiteConfig site, site_config(options.site));
  SEMVIEW_TRY(const client::ConnectionConfig config,
              connection_to(options.server, "view", client::ConnectionConfig{}.timeout));
  SEMVIEW_TRY(const MapAffine affine, read_affine(options));
  SEMVIEW_TRY(client::Connection connection, client::Connection::open(config));
  SEMVIEW_TRY(protocol::MapDescription map, client::get_map(connection, options.site.map));
  Seen seen;
  View& view = seen.view;
  client::ExactView exact;
  const auto start = std::chrono::steady_clock::now();
  if (options.pinhole.empty()) {
    view.panorama = site.profile.camera;
    SEMVIEW_TRY(exact,
                client::exact_panorama(connection, options.site.map, pose, site.profile, affine));
  } else {
    SEMVIEW_TRY(const PinholeCamera camera, read_pinhole(options.pinhole));
    SEMVIEW_TRY(exact,
                client::exact_pinhole(
                    connection, options.site.map, pose, site.profile.eye_height_m, camera));
  }
  view.cast_ms = milliseconds_since(start);
  view.engine = {map.engine, map.engine_version, map.engine_reason};
  view.labels = std::move(exact.labels);
  view.distances_m = std::move(exact.distances_m);
  seen.map = {map.summary.id,
              map.summary.name,
              map.summary.fingerprint,
              std::move(map.classes),
              map.ground_height_m + site.profile.eye_height_m,
              {}};
  return seen;
}

/// The rays of the view's pixels: x ahead, z up.
Result<picture::RayOfPixel> rays_of(const Options& options, const View& view) {
  if (view.panorama) {
    return picture::RayOfPixel(
        [camera = *view.panorama](int row, int column) { return camera.direction(row, column); });
  }
  SEMVIEW_TRY(const PinholeCamera camera, read_pinhole(options.pinhole));
  return picture::RayOfPixel([camera](int row, int column) {
    const Eigen::Vector3d d = camera.direction(row, column);
    return Eigen::Vector3d(d.z(), -d.x(), -d.y());
  });
}

Status write_files(const Options& options, const Pose2& pose, const Seen& seen) {
  const View& view = seen.view;
  if (!options.labels_file.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.labels_file, view.labels));
  }
  if (!options.range_file.empty()) {
    SEMVIEW_TRY_STATUS(io::write_png(options.range_file, io::millimetres(view.distances_m)));
  }
  if (!options.photo_file.empty()) {
    SEMVIEW_TRY(const picture::RayOfPixel ray, rays_of(options, view));
    SEMVIEW_TRY_STATUS(
        io::write_png(options.photo_file,
                      picture::draw_shaded(view.labels, view.distances_m, seen.map.classes, ray)));
  }
  picture::ViewPictureOptions picture;
  picture.title = fmt::format(
      "{}: ({:g}, {:g}) m, {:g}°", seen.map.name, pose.x_m, pose.y_m, deg_from_rad(pose.yaw_rad));
  picture.axes = view.panorama;
  if (!options.image_file.empty()) {
    const ClassTable& classes = seen.map.classes;
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

Status show(const CLI::App& verb, const Options& options) {
  if (!options.server.empty()) {
    SEMVIEW_TRY_STATUS(check_left_to_server(verb, {"--engine", "--threads", "--nearest-colour"}));
  }
  SEMVIEW_TRY(const Pose2 pose, read_pose(options));
  for (const std::string* file : {&options.labels_file,
                                  &options.range_file,
                                  &options.image_file,
                                  &options.range_image_file,
                                  &options.photo_file}) {
    if (!file->empty()) SEMVIEW_TRY_STATUS(io::check_output_png(*file));
  }
  SEMVIEW_TRY(const Seen seen,
              options.server.empty() ? see_here(options, pose) : see_there(options, pose));
  SEMVIEW_TRY_STATUS(write_files(options, pose, seen));
  const nlohmann::ordered_json result = view_summary(seen.map, pose, seen.view);
  if (result.contains("warning")) {
    fmt::print(stderr, "semview: warning: {}\n", result["warning"].get<std::string>());
  }
  if (options.json) {
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_view_summary(result);
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
  add_server_option(*verb, options->server, "cast");
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
  verb->add_option("--photo",
                   options->photo_file,
                   "PNG as a camera might have taken it, in plain materials and light: to try "
                   "`semview observe` on");
  verb->add_flag("--json", options->json, "Print pose, eye, cast time and class shares as JSON");
  verb->footer(
      "Example: semview view maps/duplex_level1 --pose 2,-3,90 --image view.png --range mm.png\n"
      "         semview view maps/tutorial --pose 1,1,0 --pinhole 300,300,320,240,640,480 "
      "--image photo.png");
  verb->callback([verb, options, &exit_code] { exit_code = report(show(*verb, *options)); });
}

}  // namespace semview::cli
