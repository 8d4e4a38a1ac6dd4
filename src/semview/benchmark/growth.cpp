// SPDX-License-Identifier: Apache-2.0
#include "semview/benchmark/growth.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/office_plan.hpp"
#include "semview/benchmark/scoring_task.hpp"
#include "semview/picture/line_plot.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/view/view_codec.hpp"

namespace semview::benchmark {
namespace {

using detail::keeping;

struct Case {
  std::string parameter;
  double value = 0.0;
  OfficePlan plan;
  int columns = 360;
};

/// The names of the parameters, and what a plot calls them.
constexpr std::array<std::array<std::string_view, 2>, 4> kParameters = {{
    {"area_m2", "plan, square metres"},
    {"pixel_cm", "pixel of the plan, cm"},
    {"classes", "classes"},
    {"columns", "panorama, columns"},
}};

std::vector<Case> cases_of(bool quick) {
  std::vector<Case> cases;
  const OfficePlan usual = quick ? OfficePlan{15.0, 12.5, 0.1, 11, 1} : OfficePlan{};
  const int columns = quick ? 120 : 360;
  using Values = std::vector<double>;
  for (const double side_m : quick ? Values{12.5, 15.0} : Values{12.5, 25.0, 50.0, 100.0, 200.0}) {
    OfficePlan plan = usual;
    plan.width_m = plan.depth_m = side_m;
    cases.push_back({"area_m2", side_m * side_m, plan, columns});
  }
  for (const double pixel_cm : quick ? Values{10.0, 20.0} : Values{1.0, 2.0, 5.0, 10.0}) {
    OfficePlan plan = usual;
    plan.resolution_m = pixel_cm / 100.0;
    cases.push_back({"pixel_cm", pixel_cm, plan, columns});
  }
  for (const int classes : quick ? std::vector{7, 11} : std::vector{7, 11, 20, 40, 80, 120}) {
    OfficePlan plan = usual;
    plan.classes = classes;
    cases.push_back({"classes", static_cast<double>(classes), plan, columns});
  }
  for (const int wide : quick ? std::vector{120, 240} : std::vector{120, 240, 360, 720, 1440}) {
    cases.push_back({"columns", static_cast<double>(wide), usual, wide});
  }
  return cases;
}

Result<GrowthPoint> measure(const Case& one, const GrowthConfig& config) {
  SEMVIEW_TRY(const auto subject, prepare_subject("office", one.plan));
  const PanoramaCamera camera = camera_of(one.columns);
  const std::size_t views = config.quick ? 2 : 12;
  SEMVIEW_TRY(const detail::ScoringTask task, detail::scoring_task(*subject, camera, views));
  std::vector<raycast::PanoramaRequest> requests;
  for (const CellIndex& cell : subject->sample(views)) {
    requests.push_back(subject->request(cell, camera));
  }
  ThreadPool pool(1);
  const TurnsConfig turns =
      config.quick ? TurnsConfig{0.0, 1, 1} : TurnsConfig{config.budget_s, 3, 200};
  std::vector<ColumnView> by_columns;
  std::vector<ColumnView> by_packets;
  const Turns casting = take_turns(
      keeping(views, by_columns, [&](std::size_t i) { return subject->runs(requests[i]); }),
      keeping(
          views,
          by_packets,
          [&](std::size_t i) { return raycast::render_column_view(*subject->scene, requests[i]); }),
      pool,
      turns);
  using Sums = std::array<std::int32_t, PoseGrid::kHeadings>;
  std::vector<Sums> sums;
  const Timing compass = time_alone(keeping(views,
                                            sums,
                                            [&](std::size_t i) {
                                              Sums of_view{};
                                              task.prepared.all_headings(task.views[i], of_view);
                                              return of_view;
                                            }),
                                    pool,
                                    turns);
  double bytes = 0.0;
  for (const ColumnView& view : by_columns) {
    bytes += static_cast<double>(encode_view(view).size());
  }
  return GrowthPoint{one.parameter,
                     one.value,
                     1e6 * casting.ours.least_s,
                     1e6 * casting.other.least_s,
                     1e6 * compass.least_s,
                     bytes / static_cast<double>(views),
                     1e3 * subject->columns_s,
                     1e3 * (subject->mesh_s + subject->scene_s),
                     subject->scene->triangles()};
}

}  // namespace

Result<std::vector<GrowthPoint>> measure_growth(
    const GrowthConfig& config, const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<Case> cases = cases_of(config.quick);
  std::vector<GrowthPoint> points;
  for (const Case& one : cases) {
    progress(points.size(), cases.size());
    SEMVIEW_TRY(GrowthPoint point, measure(one, config));
    points.push_back(std::move(point));
  }
  return points;
}

std::string to_csv(std::span<const GrowthPoint> points) {
  std::string csv =
      "parameter,value,columns_us,packets_us,compass_us,stored_bytes,columns_ready_ms,"
      "packets_ready_ms,triangles\n";
  for (const GrowthPoint& point : points) {
    csv += fmt::format("{},{:g},{:.2f},{:.2f},{:.2f},{:.1f},{:.2f},{:.2f},{}\n",
                       point.parameter,
                       point.value,
                       point.columns_us,
                       point.packets_us,
                       point.compass_us,
                       point.stored_bytes,
                       point.columns_ms,
                       point.packets_ms,
                       point.triangles);
  }
  return csv;
}

Status write_growth_svg(const std::filesystem::path& path, std::span<const GrowthPoint> points) {
  picture::LinePlot plot;
  plot.title = "How the cost of a view grows";
  plot.y_axis = "us";
  for (const auto& [parameter, name] : kParameters) {
    picture::PlotLine columns{"cast by columns", {0, 114, 178}, {}};
    picture::PlotLine packets{"cast by Embree packets", {213, 94, 0}, {}};
    picture::PlotLine compass{"compared at 120 headings", {0, 158, 115}, {}};
    for (const GrowthPoint& point : points) {
      if (point.parameter != parameter) continue;
      columns.points.push_back({point.value, point.columns_us});
      packets.points.push_back({point.value, point.packets_us});
      compass.points.push_back({point.value, point.compass_us});
    }
    plot.panels.push_back({std::string(name), {columns, packets, compass}});
  }
  return picture::write_line_plot_svg(path, plot);
}

}  // namespace semview::benchmark
