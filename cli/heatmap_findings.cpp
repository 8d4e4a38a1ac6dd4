// SPDX-License-Identifier: Apache-2.0
#include "heatmap_findings.hpp"

#include <cmath>

#include <fmt/format.h>

#include "semview/picture/heat_picture.hpp"
#include "semview/picture/sheet_picture.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kWidth_px = 1200;
constexpr int kPanelWidth_px = 700;  ///< of several

/// What the similarity of a model is called.
const char* quantity_of(const HeatMapOfMap& made) {
  return made.model == name(ScoreModel::kViews) ? "similarity" : "mean log p";
}

ordered_json number_at(const Image<float>& values, const CellIndex& cell, const CellIndex& origin) {
  const float value = values.at(cell.iy - origin.iy, cell.ix - origin.ix);
  return std::isnan(value) ? ordered_json(nullptr) : ordered_json(value);
}

RgbImage draw(const HeatMapOfMap& made,
              const std::string& quantity,
              const std::string& title,
              int width_px) {
  const similarity::HeatMap& heat = made.answer.heat;
  picture::HeatPicture picture;
  picture.values = values_of(made.answer);
  picture.quantity = quantity;
  picture.step_m = PoseGrid::kCellSize_m;
  picture.x_min_m = heat.origin.ix * PoseGrid::kCellSize_m;
  picture.y_min_m = heat.origin.iy * PoseGrid::kCellSize_m;
  picture.best = PoseGrid::center(heat.highest(picture.values));
  picture.title = title;
  picture.plan = made.plan;
  picture.truth = made.truth;
  picture.width_px = width_px;
  return picture::draw_heat_map(picture);
}

}  // namespace

const Image<float>& values_of(const client::HeatMapAnswer& answer) {
  return answer.probability.empty() ? answer.heat.similarity : answer.probability;
}

ordered_json describe(const HeatMapOfMap& made, const client::HeatMapQuestion& question) {
  const similarity::HeatMap& heat = made.answer.heat;
  const GridKey best = heat.highest(values_of(made.answer));
  const Pose2 pose = PoseGrid::center(best);
  ordered_json about{
      {"model", made.model},
      {"quantity", question.posterior ? "probability" : quantity_of(made)},
      {"map", made.id},
      {"fingerprint", to_hex(made.fingerprint)},
      {"engine", made.engine},
      {"engine_reason", made.engine_reason},
      {"origin_m",
       {heat.origin.ix * PoseGrid::kCellSize_m, heat.origin.iy * PoseGrid::kCellSize_m}},
      {"origin_cell", {heat.origin.ix, heat.origin.iy}},
      {"step_m", PoseGrid::kCellSize_m},
      {"rows", heat.similarity.rows()},
      {"columns", heat.similarity.columns()},
      {"row_0", "lowest y"},
      {"headings", question.headings},
      {"best",
       {{"x_m", pose.x_m},
        {"y_m", pose.y_m},
        {"yaw_deg", shown_deg(pose.yaw_rad)},
        {"similarity", number_at(heat.similarity, best.cell, heat.origin)}}},
      {"cells",
       {{"memory", heat.origins.memory},
        {"disk", heat.origins.disk},
        {"cast", heat.origins.cast}}}};
  if (question.posterior) {
    const bool power = question.posterior->transform == observation::WeightTransform::kPower;
    about["weighting"] = {
        {"transform", power ? "power" : "exponential"},
        {power ? "power" : "kappa", power ? question.posterior->power : question.posterior->kappa}};
    about["best"]["probability"] = number_at(made.answer.probability, best.cell, heat.origin);
  }
  if (made.truth) {
    about["truth"] = {{"x_m", made.truth->x_m},
                      {"y_m", made.truth->y_m},
                      {"yaw_deg", shown_deg(made.truth->yaw_rad)}};
    about["best"]["from_truth_m"] = distance_m(pose, *made.truth);
  }
  return about;
}

std::string in_words(const HeatMapOfMap& made, const ordered_json& about) {
  const ordered_json& best = about["best"];
  const bool of_views = made.model == name(ScoreModel::kViews);
  const std::string similarity =
      best["similarity"].is_null()
          ? std::string("unknown")
          : fmt::format("{:.{}f}", best["similarity"].get<double>(), of_views ? 4 : 6);
  return fmt::format(
      "{}{} cell{}, best {} at {:g},{:g},{:g}{}",
      of_views ? std::string() : fmt::format("{}: ", made.model),
      made.cells,
      made.cells == 1 ? "" : "s",
      best.contains("probability")
          ? fmt::format("{:.3g} (similarity {})", best["probability"].get<double>(), similarity)
          : similarity,
      best["x_m"].get<double>(),
      best["y_m"].get<double>(),
      best["yaw_deg"].get<double>(),
      made.truth ? fmt::format(", {:.2f} m from the truth", best["from_truth_m"].get<double>())
                 : "");
}

RgbImage draw(const std::vector<HeatMapOfMap>& made, const std::vector<ordered_json>& about) {
  if (made.size() == 1)
    return draw(made.front(), about.front()["quantity"], made.front().name, kWidth_px);
  picture::SheetPicture sheet;
  sheet.title = made.front().name;
  for (std::size_t i = 0; i < made.size(); ++i) {
    sheet.panels.push_back(
        {"", draw(made[i], about[i]["quantity"], made[i].model, kPanelWidth_px)});
  }
  return picture::draw_sheet(sheet);
}

}  // namespace semview::cli
