// SPDX-License-Identifier: Apache-2.0
#include "rows.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "semview/core/check.hpp"

namespace semview::paper2017 {
namespace {

Row scaled(std::string id, std::string title, double y, double x, const Printed& printed) {
  Row row{std::move(id), std::move(title)};
  row.affine = {.a = x, .b = y};
  row.printed = printed;
  return row;
}

Row sheared(std::string id, std::string title, double k, const Printed& printed) {
  Row row{std::move(id), std::move(title)};
  row.affine = {.k = k};
  row.printed = printed;
  return row;
}

Row narrowed(std::string id, std::string title, double degrees, const Printed& printed) {
  Row row{std::move(id), std::move(title)};
  row.field_of_view_rad = rad_from_deg(degrees);
  row.printed = printed;
  return row;
}

Row of_classes(std::string id, std::string title, ClassSubset classes, const Printed& printed) {
  Row row{std::move(id), std::move(title)};
  row.classes = classes;
  row.printed = printed;
  return row;
}

void set_goals(std::vector<Row>& rows) {
  // In the order of the rows.
  constexpr std::array<Goal, 18> kGoals = {{
      {0.06, 2.5},
      {0.07, 2.5},
      {0.08, 4.0},
      {0.09, 5.0},
      {0.10, 6.0},
      {0.12, 7.0},
      {0.07, 2.0},
      {0.08, 2.5},
      {0.09, 3.0},
      {0.10, 4.0},
      {0.11, 5.0},
      {0.07, 2.0},
      {0.12, 2.5},
      {0.15, 2.5},
      {0.20, 3.0},
      {0.09, 2.5},
      {0.09, 1.5},
      {0.30, 4.0},
  }};
  SEMVIEW_CHECK(rows.size() == kGoals.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].goal = kGoals[i];
}

std::vector<Row> make_rows() {
  std::vector<Row> rows;
  rows.push_back(Row{.id = "unmodified",
                     .title = "Unmodified semantic map",
                     .printed = {0.160, 0.023, 0.120, 0.020, 0.260}});
  rows.push_back(scaled(
      "scale_1.1", "Scaling by 1.10 & 0.91", 1.10, 0.91, {0.267, 0.034, 0.176, 0.033, 0.488}));
  rows.push_back(scaled(
      "scale_1.2", "Scaling by 1.20 & 0.83", 1.20, 0.83, {3.036, 0.078, 0.363, 0.052, 1.052}));
  rows.push_back(scaled(
      "scale_1.3", "Scaling by 1.30 & 0.77", 1.30, 0.77, {6.836, 0.671, 0.569, 0.073, 1.625}));
  rows.push_back(scaled(
      "scale_1.4", "Scaling by 1.40 & 0.71", 1.40, 0.71, {8.376, 1.565, 0.686, 0.097, 2.197}));
  rows.push_back(scaled(
      "scale_1.5", "Scaling by 1.50 & 0.67", 1.50, 0.67, {8.352, 1.991, 1.176, 0.122, 2.768}));
  rows.push_back(
      sheared("shear_0.1", "Shearing by 0.10", 0.1, {0.287, 0.028, 0.165, 0.026, 0.632}));
  rows.push_back(
      sheared("shear_0.2", "Shearing by 0.20", 0.2, {1.396, 0.039, 0.391, 0.042, 1.213}));
  rows.push_back(
      sheared("shear_0.3", "Shearing by 0.30", 0.3, {2.956, 0.060, 0.534, 0.056, 1.808}));
  rows.push_back(
      sheared("shear_0.4", "Shearing by 0.40", 0.4, {3.441, 0.152, 0.790, 0.079, 2.407}));
  rows.push_back(
      sheared("shear_0.5", "Shearing by 0.50", 0.5, {4.063, 0.388, 1.234, 0.118, 3.006}));
  rows.push_back(
      narrowed("fov_200", "200° field of view", 200.0, {0.160, 0.024, 0.126, 0.023, 0.260}));
  rows.push_back(
      narrowed("fov_150", "150° field of view", 150.0, {0.852, 0.169, 0.189, 0.023, 0.260}));
  rows.push_back(
      narrowed("fov_100", "100° field of view", 100.0, {0.969, 0.210, 0.284, 0.026, 0.260}));
  rows.push_back(
      narrowed("fov_50", "50° field of view", 50.0, {1.712, 0.082, 0.367, 0.051, 0.260}));
  rows.push_back(of_classes("classes_extended",
                            "Classes construction ext.",
                            ClassSubset::kConstructionExtended,
                            {0.174, 0.024, 0.186, 0.024, 0.260}));
  rows.push_back(of_classes("classes_basic",
                            "Classes construction basic",
                            ClassSubset::kConstructionBasic,
                            {1.956, 0.025, 0.252, 0.027, 0.260}));
  rows.push_back(of_classes("classes_furniture",
                            "Classes furniture",
                            ClassSubset::kFurniture,
                            {2.674, 1.069, 0.678, 0.266, 0.260}));
  set_goals(rows);
  return rows;
}

}  // namespace

const std::vector<Row>& all_rows() {
  static const std::vector<Row> kRows = make_rows();
  return kRows;
}

const Row* find_row(std::string_view id) {
  const auto& rows = all_rows();
  const auto found = std::ranges::find(rows, id, &Row::id);
  return found == rows.end() ? nullptr : &*found;
}

Result<std::vector<Row>> rows_by_id(std::span<const std::string> ids) {
  if (ids.empty()) return all_rows();
  std::vector<Row> rows;
  for (const std::string& id : ids) {
    const Row* found = find_row(id);
    if (found == nullptr) {
      std::string known;
      for (const Row& row : all_rows()) known += (known.empty() ? "" : ", ") + row.id;
      return fail(Error{ErrorCode::kInvalidArgument,
                        fmt::format("--rows {}: expected some of {}", id, known),
                        "--rows"});
    }
    rows.push_back(*found);
  }
  return rows;
}

}  // namespace semview::paper2017
