// SPDX-License-Identifier: Apache-2.0
/// `semview observe`.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "observe_options.hpp"
#include "semview/core/log.hpp"
#include "semview/io/observation_folder.hpp"
#include "semview/io/photo.hpp"
#include "semview/io/png.hpp"
#include "semview/picture/view_picture.hpp"
#include "semview/similarity/vocabulary.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using segmentation::ObservedPanorama;

struct Observed {
  ClassTable classes;
  ObservedPanorama panorama;
  std::string by;  ///< whose labels they are
};

/// Tells a person how far the network is: it may take a second a picture.
void show_progress(std::size_t done, std::size_t total) {
  if (::isatty(STDERR_FILENO) == 1) {
    fmt::print(stderr, "\r\x1b[Klabelling picture {} of {}", done + 1, total);
    std::fflush(stderr);
  } else {
    log_info(fmt::format("labelling picture {} of {}", done + 1, total));
  }
}

Result<Observed> observe_photos(const ObserveOptions& options, const segmentation::CameraRig& rig) {
  SEMVIEW_TRY(const auto segmenter, open_segmenter(options.model));
  std::vector<RgbImage> photos;
  for (const std::string& file : options.images) {
    SEMVIEW_TRY(RgbImage photo, io::read_photo(file));
    if (options.equirectangular) {
      SEMVIEW_TRY_STATUS(check_whole_sphere(file, photo.columns(), photo.rows()));
    }
    photos.push_back(std::move(photo));
  }
  Result<ObservedPanorama> panorama =
      segmentation::observe(*segmenter, rig, photos, options.panorama, show_progress);
  if (::isatty(STDERR_FILENO) == 1) fmt::print(stderr, "\r\x1b[K");
  if (!panorama) return fail(std::move(panorama).error());
  return Observed{segmenter->classes(), *std::move(panorama), segmenter->model().name};
}

/// The label file of another program, in our ids.
Result<LabelImage> read_foreign_labels(const std::string& file, int first_value, int classes) {
  SEMVIEW_TRY(LabelImage labels, io::read_png_grey(file));
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      ClassId& label = labels.at(row, column);
      const int id = label - first_value + 1;
      if (label == kUnknown || (first_value == 1 && label == 0)) {
        label = kUnknown;
      } else if (id > classes) {
        return fail(ErrorCode::kInvalidArgument,
                    fmt::format("{}: pixel at row {}, column {} is {}, expected {} to {} ({} "
                                "classes) or 255",
                                file,
                                row,
                                column,
                                label,
                                first_value,
                                classes + first_value - 1,
                                classes));
      } else {
        label = static_cast<ClassId>(id);
      }
    }
  }
  return labels;
}

Result<Observed> observe_labels(const ObserveOptions& options, const segmentation::CameraRig& rig) {
  SEMVIEW_TRY(const similarity::Vocabulary vocabulary,
              similarity::load_vocabulary(options.classes));
  const ClassTable classes = similarity::class_table(vocabulary);
  std::vector<LabelImage> images;
  for (const std::string& file : options.images) {
    SEMVIEW_TRY(LabelImage labels, read_foreign_labels(file, options.first_value, classes.size()));
    if (options.equirectangular) {
      SEMVIEW_TRY_STATUS(check_whole_sphere(file, labels.columns(), labels.rows()));
    }
    images.push_back(std::move(labels));
  }
  SEMVIEW_TRY(ObservedPanorama panorama,
              segmentation::observe_labels(rig, images, options.panorama));
  return Observed{classes, std::move(panorama), "labels of " + options.classes};
}

Status write_overlay(const ObserveOptions& options, const Observed& observed) {
  const PartialPanorama& camera = observed.panorama.camera;
  const LabelImage& labels = observed.panorama.segmentation.labels;
  picture::ViewPictureOptions picture;
  const std::size_t more = options.images.size() - 1;
  picture.title = fmt::format("{}{} ({})",
                              std::filesystem::path(options.images.front()).filename().string(),
                              more == 0 ? "" : fmt::format(" and {} more", more),
                              observed.by);
  picture.axes = PanoramaCamera{
      camera.columns, camera.rows, camera.elevation_min_rad, camera.elevation_max_rad};
  const auto palette = picture::ClassPalette::for_classes(observed.classes);
  const RgbImage& photo = observed.panorama.photo;
  return io::write_png(options.overlay,
                       photo.empty()
                           ? draw_labels(labels, observed.classes, palette, picture)
                           : draw_overlay(photo, labels, observed.classes, palette, picture));
}

/// The angle that the columns with anything seen in them take up.
double seen_width_deg(const LabelImage& labels) {
  int seen = 0;
  for (int column = 0; column < labels.columns(); ++column) {
    int row = 0;
    while (row < labels.rows() && labels.at(row, column) == kUnknown) ++row;
    seen += row < labels.rows() ? 1 : 0;
  }
  return 360.0 * seen / labels.columns();
}

/// A rig with wrong numbers shows nearly nothing, and what is left is still labelled.
void warn_of_small_view(const ObserveOptions& options, const Observed& observed) {
  constexpr double kOddShare = 0.005;
  const auto& confidence = observed.panorama.segmentation.confidence.pixels();
  const auto seen = static_cast<double>(
      std::ranges::count_if(confidence, [](std::uint8_t value) { return value > 0; }));
  const double sphere_px =
      0.5 * observed.panorama.camera.columns * observed.panorama.camera.columns;
  if (seen >= kOddShare * sphere_px) return;
  log_warning(
      fmt::format("{}: the cameras show {:.2f} % of the sphere; are their focal lengths "
                  "(pixels) and distortions right?",
                  options.camera.empty() ? options.images.front() : options.camera,
                  100.0 * seen / sphere_px));
}

nlohmann::ordered_json summary_of(const ObserveOptions& options,
                                  const Observed& observed,
                                  double seconds) {
  const segmentation::Segmentation& seen = observed.panorama.segmentation;
  std::array<std::size_t, 256> counts{};
  double confidence = 0.0;
  for (std::size_t i = 0; i < seen.labels.pixels().size(); ++i) {
    ++counts[seen.labels.pixels()[i]];
    if (seen.labels.pixels()[i] != kUnknown) confidence += seen.confidence.pixels()[i] / 255.0;
  }
  const auto total = static_cast<double>(seen.labels.pixels().size());
  const double known = total - static_cast<double>(counts[kUnknown]);
  nlohmann::ordered_json shares = nlohmann::ordered_json::object();
  std::vector<int> ids;
  for (int id = 1; id <= observed.classes.size(); ++id) {
    if (counts[static_cast<std::size_t>(id)] > 0) ids.push_back(id);
  }
  std::ranges::stable_sort(
      ids, std::greater<>(), [&](int id) { return counts[static_cast<std::size_t>(id)]; });
  for (const int id : ids) {
    shares[std::string(observed.classes.name(static_cast<ClassId>(id)))] =
        static_cast<double>(counts[static_cast<std::size_t>(id)]) / known;
  }
  const PartialPanorama& camera = observed.panorama.camera;
  return {{"observation", options.output},
          {"labels_by", observed.by},
          {"images", options.images.size()},
          {"columns", camera.columns},
          {"rows", camera.rows},
          {"elevation_min_deg", shown_deg(camera.elevation_min_rad)},
          {"elevation_max_deg", shown_deg(camera.elevation_max_rad)},
          {"seen_width_deg", seen_width_deg(seen.labels)},
          {"known_share", known / total},
          {"mean_confidence", known > 0.0 ? confidence / known : 0.0},
          {"class_shares", std::move(shares)},
          {"seconds", seconds}};
}

void print_summary(const nlohmann::ordered_json& summary) {
  fmt::print(
      "{}: {} x {} pixels of a whole turn, {:.0f} deg of it seen, {:.0f} to {:.0f} deg high, "
      "{:.0f} "
      "% known, mean confidence {:.2f}; {}\nof the known pixels (an overlay's legend counts "
      "all):\n",
      summary["observation"].get<std::string>(),
      summary["columns"].get<int>(),
      summary["rows"].get<int>(),
      summary["seen_width_deg"].get<double>(),
      summary["elevation_min_deg"].get<double>(),
      summary["elevation_max_deg"].get<double>(),
      100.0 * summary["known_share"].get<double>(),
      summary["mean_confidence"].get<double>(),
      summary["labels_by"].get<std::string>());
  for (const auto& [name, share] : summary["class_shares"].items()) {
    fmt::print("  {:16} {:5.1f} %\n", name, 100.0 * share.get<double>());
  }
}

Status observe(const ObserveOptions& options) {
  SEMVIEW_TRY_STATUS(check_observe_options(options));
  SEMVIEW_TRY(const segmentation::CameraRig rig, observe_rig(options));
  const auto start = std::chrono::steady_clock::now();
  SEMVIEW_TRY(const Observed observed,
              options.labels ? observe_labels(options, rig) : observe_photos(options, rig));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  warn_of_small_view(options, observed);
  SEMVIEW_TRY_STATUS(io::write_observation(options.output,
                                           {observed.classes, observed.panorama.camera},
                                           observed.panorama.segmentation.labels,
                                           options.stamp_s,
                                           observed.panorama.segmentation.confidence));
  if (!options.overlay.empty()) SEMVIEW_TRY_STATUS(write_overlay(options, observed));
  const nlohmann::ordered_json summary = summary_of(options, observed, taken.count());
  if (options.json) {
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print_summary(summary);
  }
  return {};
}

}  // namespace

void add_observe_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "observe",
      "Turn photographs into an observation: a network labels them, and they are warped onto one "
      "spherical panorama around the robot, the camera's roll and pitch undone. Where images "
      "overlap, the surer network and the one farther from its border win; what no camera shows is "
      "unknown. The folder that it writes is what `semview score` and `semview heatmap` take as "
      "--obs.");
  const auto options = std::make_shared<ObserveOptions>();
  add_observe_options(*verb, *options);
  verb->footer(
      "Examples:\n"
      "  semview observe room.jpg --equirectangular -o obs --overlay obs.png\n"
      "  semview observe pan0.png pan1.png pan2.png --camera rig.yaml -o obs\n"
      "  semview observe ids.png --labels --classes ade20k150 --camera rig.yaml -o obs\n"
      "Then: semview heatmap MAP --obs obs --weights MAP/weights.csv -o heat.png");
  verb->callback([options, &exit_code] { exit_code = report(observe(*options)); });
}

}  // namespace semview::cli
