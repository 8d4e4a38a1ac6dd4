// SPDX-License-Identifier: Apache-2.0
/// `semview weights init` and `semview weights check`.
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "semview/io/output_path.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/similarity/vocabulary.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/similarity/weight_proposal.hpp"
#include "verb.hpp"
#include "weights_verbs.hpp"

namespace semview::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string map;
  std::string vocabulary = "ade20k150";
  std::string weights;
  map::LoadOptions load;
  bool json = false;
};

std::string dump(const ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

similarity::Vocabulary map_vocabulary(const map::SemanticMap& map) {
  similarity::Vocabulary classes;
  for (const map::MapClass& details : map.class_details) {
    classes.push_back({details.name, details.aliases});
  }
  return classes;
}

/// A run log brings the names that its observations use.
Result<similarity::Vocabulary> read_vocabulary(const std::string& name) {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::path(name) / "log.yaml", ignored)) {
    return similarity::load_vocabulary(name);
  }
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(name));
  similarity::Vocabulary vocabulary;
  for (const std::string& observed : log.setup.classes.names()) vocabulary.push_back({observed});
  return vocabulary;
}

void print_unmatched(const similarity::WeightProposal& proposal) {
  if (!proposal.unmatched_map.empty()) {
    fmt::print(
        "no class of the vocabulary speaks for these map classes, give them weights by hand:\n  "
        "{}\n",
        fmt::join(proposal.unmatched_map, ", "));
  }
  if (!proposal.unmatched_observed.empty()) {
    fmt::print("{} observed classes match nothing on the map, they do not count:\n  {}\n",
               proposal.unmatched_observed.size(),
               fmt::join(proposal.unmatched_observed, ", "));
  }
}

Status init(const Options& options) {
  SEMVIEW_TRY_STATUS(io::check_output_file(options.weights));
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  SEMVIEW_TRY(const similarity::Vocabulary observed, read_vocabulary(options.vocabulary));
  SEMVIEW_TRY(const similarity::WeightProposal proposal,
              similarity::propose_weights(observed, map_vocabulary(map)));
  const bool more_rows = proposal.matrix.observed_names().size() > observed.size();
  const std::string header = fmt::format(
      "# Rows: {}{}. Columns: map {}. Made by `semview weights init`; edit it freely.\n",
      std::filesystem::path(options.vocabulary).filename().string(),
      more_rows ? " and what else the map names" : "",
      map.id);
  SEMVIEW_TRY_STATUS(io::write_text_file(options.weights, header + proposal.matrix.to_csv()));
  if (options.json) {
    fmt::print("{}\n",
               dump({{"weights", options.weights},
                     {"observed_classes", proposal.matrix.observed_names().size()},
                     {"map_classes", map.classes.size()},
                     {"unmatched_map", proposal.unmatched_map},
                     {"unmatched_observed", proposal.unmatched_observed}}));
    return {};
  }
  fmt::print("{}: {} observed classes x {} map classes\n",
             options.weights,
             proposal.matrix.observed_names().size(),
             map.classes.size());
  print_unmatched(proposal);
  return {};
}

Status check(const Options& options) {
  SEMVIEW_TRY(const map::SemanticMap map, map::load_map(options.map, options.load));
  SEMVIEW_TRY(const similarity::WeightMatrix weights,
              similarity::read_weight_matrix(options.weights));
  ClassTable observed;
  if (!options.vocabulary.empty()) {
    SEMVIEW_TRY(const similarity::Vocabulary vocabulary, read_vocabulary(options.vocabulary));
    observed = similarity::class_table(vocabulary);
  }
  if (Status status = weights.check(observed, map.classes); !status) {
    return with_context(std::move(status), options.weights);
  }
  if (options.json) {
    fmt::print("{}\n",
               dump({{"ok", true},
                     {"rows", weights.observed_names().size()},
                     {"columns", weights.map_names().size()},
                     {"bands", weights.bands().size()},
                     {"max_abs_weight", weights.max_abs_weight()}}));
    return {};
  }
  fmt::print("{}: {} rows, {} columns, {} elevation band{}, weights up to {:g}: covers map {}{}\n",
             options.weights,
             weights.observed_names().size(),
             weights.map_names().size(),
             weights.bands().size(),
             weights.bands().size() == 1 ? "" : "s",
             weights.max_abs_weight(),
             map.id,
             options.vocabulary.empty() ? "" : " and " + options.vocabulary);
  return {};
}

void add_map(CLI::App& verb, Options& options) {
  verb.add_option("MAP", options.map, "Map folder, map.yaml, .glb or .vdb file")->required();
  verb.add_flag("--nearest-colour",
                options.load.nearest_colour,
                "Take unknown colours to be the nearest class's");
  verb.add_flag("--json", options.json, "Print the result as JSON");
}

}  // namespace

void add_weights_verb(CLI::App& app, int& exit_code) {
  CLI::App* weights =
      app.add_subcommand("weights",
                         "Make and check weight matrices: how much an observed class speaks for "
                         "(or against) each class of the map.");
  weights->require_subcommand(1);

  CLI::App* init_verb = weights->add_subcommand(
      "init",
      "Write a starting matrix for a map by names, aliases and the synonyms that semview knows: "
      "soft matches between 0 and 1, 0.25 for walls, floors and ceilings, -1 for wall against "
      "floor. A class that only the map names gets a row as well. Lists what it could not match.");
  const auto init_options = std::make_shared<Options>();
  add_map(*init_verb, *init_options);
  init_verb
      ->add_option(
          "--vocabulary",
          init_options->vocabulary,
          "What the segmentation knows: ade20k150, ade20k32 (the shipped network), a file with one "
          "class name a line, or a run log for the names in it")
      ->capture_default_str();
  init_verb->add_option("-o,--output", init_options->weights, "CSV file to write")->required();
  init_verb->footer("Example: semview weights init maps/tutorial --vocabulary ade20k150 -o w.csv");
  init_verb->callback([init_options, &exit_code] { exit_code = report(init(*init_options)); });

  CLI::App* check_verb = weights->add_subcommand(
      "check",
      "Check that a matrix is well-formed and has a column for every class of the map (and a row "
      "for every name of a vocabulary).");
  const auto check_options = std::make_shared<Options>();
  check_options->vocabulary.clear();
  add_map(*check_verb, *check_options);
  check_verb->add_option("WEIGHTS", check_options->weights, "CSV file")->required();
  check_verb->add_option("--vocabulary",
                         check_options->vocabulary,
                         "Also check the rows: ade20k150, ade20k32, a file, or a run log");
  check_verb->footer("Example: semview weights check maps/tutorial w.csv --vocabulary ade20k150");
  check_verb->callback([check_options, &exit_code] { exit_code = report(check(*check_options)); });

  add_weights_learn(*weights, exit_code);
  add_weights_show(*weights, exit_code);
}

}  // namespace semview::cli
