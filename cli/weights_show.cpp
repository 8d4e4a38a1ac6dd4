// SPDX-License-Identifier: Apache-2.0
/// `semview weights show`.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "semview/io/output_path.hpp"
#include "semview/io/png.hpp"
#include "semview/picture/matrix_picture.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "verb.hpp"
#include "weights_verbs.hpp"

namespace semview::cli {
namespace {

struct Options {
  std::string weights;
  std::string output;
  bool all = false;
  bool json = false;
};

std::string band_name(const similarity::WeightMatrix::Band& band) {
  return fmt::format("{:g} to {:g} deg", band.elevation_min_deg, band.elevation_max_deg);
}

/// Rows that say something; all of them if so wanted.
std::vector<std::size_t> rows_of(const similarity::WeightMatrix& weights, bool all) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < weights.observed_names().size(); ++i) {
    bool says = all;
    for (std::size_t b = 0; b < weights.bands().size(); ++b) {
      for (std::size_t j = 0; j < weights.map_names().size(); ++j) {
        says = says || weights.weight(b, i, j) != 0.0;
      }
    }
    if (says) rows.push_back(i);
  }
  return rows;
}

void print_bands(const similarity::WeightMatrix& weights, const std::vector<std::size_t>& rows) {
  std::size_t name_width = 8;
  for (const std::size_t row : rows) {
    name_width = std::max(name_width, weights.observed_names()[row].size());
  }
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    if (b > 0) fmt::print("\n");
    fmt::print("elevation {}\n{:<{}}", band_name(weights.bands()[b]), "observed", name_width);
    for (const std::string& name : weights.map_names()) {
      fmt::print("  {:>{}}", name, std::max<std::size_t>(6, name.size()));
    }
    fmt::print("\n");
    for (const std::size_t row : rows) {
      fmt::print("{:<{}}", weights.observed_names()[row], name_width);
      for (std::size_t j = 0; j < weights.map_names().size(); ++j) {
        fmt::print("  {:>{}.2f}",
                   weights.weight(b, row, j),
                   std::max<std::size_t>(6, weights.map_names()[j].size()));
      }
      fmt::print("\n");
    }
  }
}

void print_json(const similarity::WeightMatrix& weights, const std::vector<std::size_t>& rows) {
  using nlohmann::ordered_json;
  ordered_json bands = ordered_json::array();
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    ordered_json table = ordered_json::array();
    for (const std::size_t row : rows) {
      ordered_json line = ordered_json::array();
      for (std::size_t j = 0; j < weights.map_names().size(); ++j) {
        line.push_back(weights.weight(b, row, j));
      }
      table.push_back(std::move(line));
    }
    bands.push_back({{"elevation_min_deg", weights.bands()[b].elevation_min_deg},
                     {"elevation_max_deg", weights.bands()[b].elevation_max_deg},
                     {"weights", std::move(table)}});
  }
  ordered_json observed = ordered_json::array();
  for (const std::size_t row : rows) observed.push_back(weights.observed_names()[row]);
  const ordered_json json{
      {"observed", std::move(observed)}, {"map", weights.map_names()}, {"bands", std::move(bands)}};
  fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

picture::MatrixPicture picture_of(const Options& options,
                                  const similarity::WeightMatrix& weights,
                                  const std::vector<std::size_t>& rows) {
  picture::MatrixPicture picture;
  picture.title = std::filesystem::path(options.weights).filename().string();
  picture.row_axis = "observed";
  picture.column_axis = "map";
  picture.columns.assign(weights.map_names().begin(), weights.map_names().end());
  for (const std::size_t row : rows) picture.rows.push_back(weights.observed_names()[row]);
  for (std::size_t b = 0; b < weights.bands().size(); ++b) {
    Image<double> values(static_cast<int>(rows.size()), static_cast<int>(picture.columns.size()));
    for (int r = 0; r < values.rows(); ++r) {
      for (int c = 0; c < values.columns(); ++c) {
        values.at(r, c) =
            weights.weight(b, rows[static_cast<std::size_t>(r)], static_cast<std::size_t>(c));
      }
    }
    picture.values.push_back(std::move(values));
    picture.value_names.push_back(band_name(weights.bands()[b]));
  }
  return picture;
}

Status show(const Options& options) {
  if (!options.output.empty()) SEMVIEW_TRY_STATUS(io::check_output_png(options.output));
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              similarity::read_weight_matrix(options.weights));
  const std::vector<std::size_t> rows = rows_of(weights, options.all);
  // The file first: `| head` ends a program that prints.
  if (!options.output.empty()) {
    const RgbImage picture = picture::draw_matrix(picture_of(options, weights, rows));
    SEMVIEW_TRY_STATUS(io::write_png(options.output, picture));
  }
  if (options.json) {
    print_json(weights, rows);
  } else {
    print_bands(weights, rows);
  }
  return {};
}

}  // namespace

void add_weights_show(CLI::App& weights, int& exit_code) {
  CLI::App* verb = weights.add_subcommand(
      "show",
      "Print a matrix as a table a band of elevation, rows that say nothing left out, and draw it: "
      "blue speaks for, red against.");
  const auto options = std::make_shared<Options>();
  verb->add_option("WEIGHTS", options->weights, "CSV file")->required();
  verb->add_option("-o,--output", options->output, "Picture to write")->type_name("FILE.png");
  verb->add_flag("--all", options->all, "Also the rows that say nothing");
  verb->add_flag("--json", options->json, "Print the matrix as JSON: a table a band");
  verb->footer("Example: semview weights show learned.csv -o learned.png");
  verb->callback([options, &exit_code] { exit_code = report(show(*options)); });
}

}  // namespace semview::cli
