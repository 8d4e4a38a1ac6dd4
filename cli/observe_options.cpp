// SPDX-License-Identifier: Apache-2.0
#include "observe_options.hpp"

#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "data_folder.hpp"
#include "semview/io/output_path.hpp"

namespace semview::cli {
namespace {

/// Some 30 000 years; beyond it a double holds no milliseconds.
constexpr double kLatestStamp_s = 1e12;

constexpr double kMostEyeHeight_m = 100.0;  // as of views

tl::unexpected<Error> usage(const std::string& option, const std::string& message) {
  return fail(Error{ErrorCode::kInvalidArgument, fmt::format("{}: {}", option, message), option});
}

}  // namespace

void add_observe_options(CLI::App& verb, ObserveOptions& options) {
  verb.add_option("IMAGE", options.images, "PNG or JPEG photographs, one a camera of the rig")
      ->required();
  verb.add_option("-o,--out", options.output, "Folder of the observation; replaced if it is there")
      ->type_name("OBS")
      ->required();
  auto* camera = verb.add_option("--camera",
                                 options.camera,
                                 "Camera rig: intrinsics, lens and mount angles of each camera, "
                                 "tilted panoramas too (docs/formats/camera_rig.md)")
                     ->type_name("RIG.yaml");
  auto* whole = verb.add_flag("--equirectangular",
                              options.equirectangular,
                              "IMAGE is one level equirectangular photograph of the whole sphere, "
                              "the robot's heading in its middle")
                    ->excludes(camera);
  verb.add_option("--eye-height", options.eye_height_m, "--equirectangular: camera height in m")
      ->capture_default_str()
      ->needs(whole);
  auto* model = verb.add_option("--model",
                                options.model,
                                "Network: a shipped model's name, or a folder with model.yaml "
                                "(docs/formats/segmentation_model.md)")
                    ->type_name("MODEL")
                    ->capture_default_str();
  auto* labels = verb.add_flag("--labels",
                               options.labels,
                               "The images are labels already, 8-bit PNGs of another program; no "
                               "network is run")
                     ->excludes(model);
  verb.add_option(
          "--classes",
          options.classes,
          "--labels: their vocabulary, `ade20k150`, `ade20k32` or a file of one name a line")
      ->type_name("VOCABULARY")
      ->needs(labels);
  verb.add_option("--first-value",
                  options.first_value,
                  "--labels: pixel value of the first class, 1 or 0; 255 is unknown")
      ->check(CLI::IsMember({0, 1}))
      ->capture_default_str()
      ->needs(labels);
  verb.add_option("--overlay", options.overlay, "Picture of the photograph with its labels over it")
      ->type_name("PNG");
  verb.add_option("--columns", options.panorama.columns, "Pixels of the panorama's full turn")
      ->capture_default_str();
  verb.add_option("--stamp", options.stamp_s, "When the photographs were taken, in seconds")
      ->capture_default_str();
  verb.add_flag("--json", options.json, "Print what was seen as JSON");
}

Status check_observe_options(const ObserveOptions& options) {
  if (options.camera.empty() && !options.equirectangular) {
    return usage("--camera",
                 "expected what took the images: --camera RIG.yaml, or --equirectangular for one "
                 "panorama photograph");
  }
  if (options.labels && options.classes.empty()) {
    return usage("--classes", "expected with --labels: a vocabulary, for example ade20k150");
  }
  if (const Status valid = validate(options.panorama); !valid) {
    return usage("--columns", valid.error().message);
  }
  if (!(options.eye_height_m > 0.0 && options.eye_height_m <= kMostEyeHeight_m)) {
    return usage("--eye-height",
                 fmt::format("{:g}: expected a height above 0 m and up to {:g} m",
                             options.eye_height_m,
                             kMostEyeHeight_m));
  }
  if (!(std::abs(options.stamp_s) <= kLatestStamp_s)) {
    return usage("--stamp",
                 fmt::format("{:g}: expected seconds from {:g} to {:g}",
                             options.stamp_s,
                             -kLatestStamp_s,
                             kLatestStamp_s));
  }
  if (!options.overlay.empty()) {
    SEMVIEW_TRY_STATUS(io::check_output_png(options.overlay));
    SEMVIEW_TRY_STATUS(io::check_is_no_input(options.overlay, options.images));
  }
  for (const char* file : {"labels.png", "confidence.png"}) {
    SEMVIEW_TRY_STATUS(
        io::check_is_no_input(std::filesystem::path(options.output) / file, options.images));
  }
  SEMVIEW_TRY_STATUS(io::check_holds_nothing_else(options.output, io::FolderKind::kObservation));
  return io::check_output_folder(options.output);
}

Result<segmentation::CameraRig> observe_rig(const ObserveOptions& options) {
  segmentation::CameraRig rig = segmentation::equirectangular_rig(options.eye_height_m);
  if (!options.camera.empty()) {
    SEMVIEW_TRY(rig, segmentation::read_camera_rig(options.camera));
  }
  if (rig.cameras.size() != options.images.size()) {
    return fail(Error{
        ErrorCode::kInvalidArgument,
        fmt::format("IMAGE: {} given, expected {}{}",
                    options.images.size(),
                    rig.cameras.size(),
                    options.camera.empty() ? " with --equirectangular"
                                           : fmt::format(", one a camera of {}", options.camera)),
        "--camera"});
  }
  return rig;
}

Status check_whole_sphere(const std::string& file, int columns, int rows) {
  constexpr double kTolerance = 0.02;
  if (std::abs(columns / (2.0 * rows) - 1.0) <= kTolerance) return {};
  return fail(Error{ErrorCode::kInvalidArgument,
                    fmt::format("{}: {} x {} pixels, expected twice as wide as high of a "
                                "photograph of the whole sphere",
                                file,
                                columns,
                                rows),
                    {},
                    "say with --camera RIG.yaml what took it (docs/formats/camera_rig.md), also "
                    "where a panorama shows a part of the sphere"});
}

Result<std::unique_ptr<segmentation::OnnxSegmenter>> open_segmenter(const std::string& model) {
  SEMVIEW_TRY(const std::filesystem::path file,
              segmentation::find_segmentation_model(model, data_folder() / "models"));
  return segmentation::OnnxSegmenter::load(file);
}

}  // namespace semview::cli
