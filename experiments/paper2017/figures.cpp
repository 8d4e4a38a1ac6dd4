// SPDX-License-Identifier: Apache-2.0
#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "row_map.hpp"
#include "semview/map/distortion.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/picture/box_plot.hpp"
#include "semview/picture/track_picture.hpp"

namespace semview::paper2017 {
namespace {

constexpr Rgb kWeightedColour{230, 159, 0};
constexpr Rgb kOursColour = picture::kEstimateColour;
constexpr Rgb kMeanColour{86, 180, 233};
constexpr double kOverlayStep_m = 0.04;

picture::PlotBox plot_box(const std::vector<double>& values) {
  if (values.empty()) return {};
  evaluation::BoxSummary box = evaluation::box_summary(values);
  return {box.low_whisker,
          box.low_quartile,
          box.median,
          box.high_quartile,
          box.high_whisker,
          std::move(box.outliers)};
}

picture::BoxSeries series_of(const Results& results,
                             const std::string& row,
                             const std::string& method,
                             Start start,
                             Field field,
                             const std::string& name,
                             Rgb colour) {
  picture::BoxSeries series{name, colour, {}};
  for (int stop = 1; stop <= kStops; ++stop) {
    series.boxes.push_back(plot_box(results.values_at(row, method, start, field, stop)));
  }
  return series;
}

picture::BoxCurve odometry_of(const Results& results,
                              const std::string& row,
                              const std::string& method,
                              Start start) {
  picture::BoxCurve curve{"odometry", picture::kTruthColour, {}};
  for (int stop = 1; stop <= kStops; ++stop) {
    curve.values.push_back(
        evaluation::mean(results.values_at(row, method, start, &StopRecord::odometry_m, stop)));
  }
  return curve;
}

bool has_drives(const Results& results,
                const std::string& row,
                const std::string& method,
                Start start) {
  return !results.values_at(row, method, start, &StopRecord::estimate_m, 1).empty();
}

/// Whether anything is drawn at a place of frame `map`.
bool stands(const map::SemanticMap& map, double x_m, double y_m) {
  const ColumnProfile* profile = map.columns()->at(x_m, y_m);
  return profile != nullptr && !profile->outside && !profile->slabs.empty();
}

/// What the true plan draws in grey, what the distorted one draws in colour over it.
picture::Plan overlay(const map::SemanticMap& drawn,
                      const map::SemanticMap& distorted,
                      const MapAffine& affine,
                      const Layout& layout) {
  const Pose2 far = map::distort({layout.width_m, layout.depth_m, 0.0}, affine);
  const double width_m = std::max(layout.width_m, far.x_m) + 1.0;
  const double depth_m = std::max(layout.depth_m, far.y_m) + 1.0;
  picture::Plan plan;
  plan.resolution_m = kOverlayStep_m;
  plan.origin = {-0.5, -0.5, 0.0};
  plan.image = RgbImage(static_cast<int>(std::lround(depth_m / kOverlayStep_m)),
                        static_cast<int>(std::lround(width_m / kOverlayStep_m)),
                        Rgb{255, 255, 255});
  for (int row = 0; row < plan.image.rows(); ++row) {
    const double y_m = plan.origin.y_m + (plan.image.rows() - 1 - row + 0.5) * kOverlayStep_m;
    for (int column = 0; column < plan.image.columns(); ++column) {
      const double x_m = plan.origin.x_m + (column + 0.5) * kOverlayStep_m;
      if (stands(drawn, x_m, y_m)) plan.image.at(row, column) = {190, 194, 200};
      if (stands(distorted, x_m, y_m)) plan.image.at(row, column) = kOursColour;
    }
  }
  return plan;
}

}  // namespace

Status write_fig2(const Results& results, const std::filesystem::path& directory) {
  const Experiment& experiment = results.experiment();
  const std::uint64_t seed = experiment.config.worlds.front();
  const Layout& layout = experiment.worlds.front().layout;
  const std::filesystem::path plans = experiment.config.out / "plans";
  SEMVIEW_TRY_STATUS(draw_world_plan(layout, seed, ClassSubset::kAll, false, plans));
  SEMVIEW_TRY(const map::SemanticMap drawn,
              map::load_map(plan_directory(plans, seed, ClassSubset::kAll, false)));
  for (const char* id : {"scale_1.5", "shear_0.5"}) {
    const Row& row = *find_row(id);
    SEMVIEW_TRY(const map::SemanticMap distorted, map::distort(drawn, row.affine));
    picture::TrackPicture drawing;
    drawing.title = fmt::format("World {}: the plan (grey) and {} (blue)", seed, row.title);
    drawing.plan = overlay(drawn, distorted, row.affine, layout);
    SEMVIEW_TRY_STATUS(
        picture::write_tracks_svg(directory / fmt::format("fig2_{}.svg", id), drawing));
  }
  return {};
}

Status write_fig3(const Results& results, const std::filesystem::path& directory) {
  picture::BoxPlot plot;
  plot.title = "Unmodified map, known start: distance to the true place";
  plot.x_axis = "image";
  plot.y_axis = "m";
  plot.panel_columns = 2;
  plot.same_scale = true;
  const std::string row = "unmodified";
  for (const auto& [method, title] : {std::pair("weighted_odometry", "heading by odometry"),
                                      std::pair("weighted", "heading by visual compass")}) {
    if (!has_drives(results, row, method, Start::kLocal)) return {};
    picture::BoxPanel panel{title, {}, {odometry_of(results, row, method, Start::kLocal)}};
    const auto add = [&](Field field, const char* name, Rgb colour) {
      panel.series.push_back(series_of(results, row, method, Start::kLocal, field, name, colour));
    };
    add(&StopRecord::best_m, "best particle", kOursColour);
    add(&StopRecord::weighted_mean_m, "particles by weight", kWeightedColour);
    add(&StopRecord::mean_m, "all particles", kMeanColour);
    plot.panels.push_back(std::move(panel));
  }
  return picture::write_box_plot_svg(directory / "fig3_left.svg", plot);
}

Status write_fig4(const Results& results, const std::filesystem::path& directory) {
  for (const Start start : results.experiment().config.starts) {
    picture::BoxPlot plot;
    plot.title = fmt::format("{} start: error at each image, over worlds and runs",
                             start == Start::kLocal ? "Known" : "Unknown");
    plot.x_axis = "image";
    plot.y_axis = "m";
    plot.panel_columns = 3;
    for (const Row& row : results.experiment().rows) {
      picture::BoxPanel panel{row.title, {}, {}};
      for (const auto& [method, colour] :
           {std::pair("weighted", kWeightedColour), std::pair("ours", kOursColour)}) {
        if (!has_drives(results, row.id, method, start)) continue;
        panel.series.push_back(
            series_of(results, row.id, method, start, &StopRecord::estimate_m, method, colour));
        if (panel.curves.empty()) {
          panel.curves.push_back(odometry_of(results, row.id, method, start));
        }
      }
      if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
    }
    if (plot.panels.empty()) continue;
    SEMVIEW_TRY_STATUS(
        picture::write_box_plot_svg(directory / fmt::format("fig4_{}.svg", name(start)), plot));
  }
  return {};
}

}  // namespace semview::paper2017
