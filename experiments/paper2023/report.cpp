// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "experiments/paper2017/guard.hpp"
#include "semview/io/text_file.hpp"
#include "semview/picture/line_plot.hpp"
#include "summary.hpp"

namespace semview::paper2023 {
namespace {

constexpr const char* kObservationScene = "solids of the flat on the day of the drive";
constexpr const char* kMapScene = "a volume fused of noisy depth images with noisy poses";
constexpr const char* kMapRenderer = "distance fields of its voxels";

/// Figs. 5 and 8.
Status write_error_plot(const Experiment& experiment,
                        Session session,
                        const std::filesystem::path& path) {
  // In the order of `default_methods()`, apart for the colour-blind too (Okabe, Ito 2008).
  static constexpr std::array<Rgb, 7> kColours = {{{0, 158, 115},
                                                   {230, 159, 0},
                                                   {213, 94, 0},
                                                   {0, 114, 178},
                                                   {86, 180, 233},
                                                   {0, 0, 0},
                                                   {204, 121, 167}}};
  const std::vector<Method> methods = default_methods();
  picture::PlotPanel panel;
  panel.x_axis = "driven, m";
  for (const ErrorCurve& curve : error_curves(experiment, session)) {
    const auto index = std::ranges::find(methods, curve.method, &Method::id) - methods.begin();
    if (index == std::ssize(methods)) continue;  // of the ablation
    picture::PlotLine line;
    line.name = curve.method;
    line.colour = kColours[static_cast<std::size_t>(index)];
    for (std::size_t i = 0; i < curve.distance_m.size(); ++i) {
      line.points.push_back({curve.distance_m[i], std::max(1e-3, curve.position_m[i])});
    }
    panel.lines.push_back(std::move(line));
  }
  return picture::write_line_plot_svg(
      path,
      {fmt::format("Mean position error, {}", name(session)), "error, m", {std::move(panel)}});
}

}  // namespace

std::string report(const Experiment& experiment, const paper2017::ReportHeader& header) {
  std::string worlds;
  for (const std::uint64_t world : experiment.config.worlds) worlds += fmt::format(" {}", world);
  const paper2017::Provenance provenance{
      kObservationScene, paper2017::kObservationRenderer, kMapScene, kMapRenderer};
  std::string text = fmt::format(
      "# Gómez et al. 2023 on generated flats\n\n"
      "`{}`, commit {}, {}, {} threads, {:.0f} s.\n"
      "{} flats{} by seed.\n"
      "{}.\n",
      header.command,
      header.revision,
      header.cpu,
      header.threads,
      header.wall_s,
      paper2017::name(experiment.use),
      worlds,
      paper2017::to_text(provenance));
  text += "\n## Table 1: the flat as it was mapped\n\n" + error_table(experiment, Session::kStatic);
  text += "\n## Table 2: after changes\n\n" + error_table(experiment, Session::kChanged);
  text += "\n## After changes against before\n\n" + ratio_table(experiment);
  text += "\n## Settings\n\n```\n" + describe(experiment.config) + "```\n";
  return text;
}

Result<std::string> write_report(const Experiment& experiment,
                                 const paper2017::ReportHeader& header,
                                 const std::filesystem::path& directory) {
  std::string page = report(experiment, header);
  std::error_code ignored;  // what cannot be made is named by what cannot be written
  std::filesystem::create_directories(directory, ignored);
  SEMVIEW_TRY_STATUS(io::write_text_file(directory / "report.md", page));
  SEMVIEW_TRY_STATUS(io::write_text_file(directory / "runs.csv", to_csv(experiment)));
  for (const Session session : {Session::kStatic, Session::kChanged}) {
    SEMVIEW_TRY_STATUS(write_error_plot(
        experiment, session, directory / fmt::format("error_{}.svg", name(session))));
  }
  return page;
}

}  // namespace semview::paper2023
