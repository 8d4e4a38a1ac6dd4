// SPDX-License-Identifier: Apache-2.0
/// `semview evaluate paper2023`.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "evaluate_verbs.hpp"
#include "experiments/paper2023/recording_export.hpp"
#include "threads_option.hpp"
#include "verb.hpp"
#include "world_list.hpp"

namespace semview::cli {
namespace {

struct Options {
  paper2023::ExportConfig recordings;
  std::string worlds;
  std::string export_to;
};

Status run(const CLI::App& verb, const Options& options) {
  paper2023::ExportConfig config = options.recordings;
  if (verb.count("--worlds") > 0) {
    SEMVIEW_TRY(config.worlds, parse_worlds(options.worlds));
  }
  const bool terminal = isatty(STDERR_FILENO) != 0;
  SEMVIEW_TRY_STATUS(paper2023::export_recordings(
      config, options.export_to, [terminal](std::size_t done, std::size_t all) {
        if (terminal) fmt::print(stderr, "\r\033[K[{}/{}]{}", done, all, done < all ? "" : "\n");
      }));
  fmt::print(
      "{0}/input: run logs, listed in list.csv; of each world one to map and others to localize "
      "on\n"
      "{0}/truth: where the robot was\n",
      options.export_to);
  return {};
}

}  // namespace

void add_evaluate_paper2023_verb(CLI::App& evaluate, int& exit_code) {
  CLI::App* verb = evaluate.add_subcommand(
      "paper2023",
      "The rooms that change of Gomez et al. 2023, as generated flats: writes what an RGB-D robot "
      "records of them as run logs, a survey to map and paths to localize on, as mapped and after "
      "changes. See experiments/paper2023/README.md.");
  const auto options = std::make_shared<Options>();
  verb->add_option("--worlds", options->worlds, "Seeds of flats; default: 1")
      ->type_name("A..B,C,...");
  verb->add_option("--paths", options->recordings.changed_paths, "Paths after changes a flat")
      ->capture_default_str();
  add_threads_option(*verb, options->recordings.threads);
  verb->add_option("--export",
                   options->export_to,
                   "Folder for the run logs and, apart from them, where the robot was")
      ->type_name("DIR")
      ->required();
  verb->footer("Example: semview evaluate paper2023 --export flats");
  verb->callback([verb, options, &exit_code] { exit_code = report(run(*verb, *options)); });
}

}  // namespace semview::cli
