// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <string_view>

#include <fmt/format.h>

#include "guard.hpp"
#include "semview/io/text_file.hpp"
#include "tables.hpp"

namespace semview::paper2017 {
namespace {

/// A resumed run's time is that of what was left to do.
std::string time_text(const Experiment& experiment, double wall_s) {
  if (experiment.kept_units == 0) return fmt::format("{:.0f} s", wall_s);
  return fmt::format("{:.0f} s for {} of {} rows on worlds, the others of earlier runs",
                     wall_s,
                     experiment.units - experiment.kept_units,
                     experiment.units);
}

std::string head(const Results& results, const ReportHeader& header) {
  const Experiment& experiment = results.experiment();
  std::string worlds;
  for (const std::uint64_t world : experiment.config.worlds) worlds += fmt::format(" {}", world);
  const Provenance provenance{
      kObservationScene, kObservationRenderer, kMapScene, "engine " + experiment.config.engine};
  return fmt::format(
      "# Neubert, Schubert, Protzel 2017 on generated worlds\n\n"
      "`{}`, commit {}, {}, {} threads, {}.\n"
      "{} rows, {} worlds{} by seed, {} runs each, seed {}.\n"
      "{}.\n",
      header.command,
      header.revision,
      header.cpu,
      header.threads,
      time_text(experiment, header.wall_s),
      experiment.rows.size(),
      name(experiment.use),
      worlds,
      experiment.config.runs,
      experiment.config.seed,
      to_text(provenance));
}

}  // namespace

std::string cpu_name() {
  constexpr std::size_t kMaxBytes = std::size_t{4} << 20U;
  const auto text = io::read_text_file("/proc/cpuinfo", kMaxBytes);
  constexpr std::string_view kKey = "model name";
  const std::size_t at = text ? text->find(kKey) : std::string::npos;
  if (at == std::string::npos) return "unknown";
  const std::size_t from = text->find_first_not_of(" \t:", at + kKey.size());
  return text->substr(from, text->find('\n', from) - from);
}

std::string report(const Results& results, const ReportHeader& header) {
  std::string text = head(results, header);
  const auto section = [&](const std::string& title, const std::string& table) {
    if (!table.empty()) text += fmt::format("\n## {}\n\n{}", title, table);
  };
  for (const Start start : results.experiment().config.starts) {
    section(fmt::format("Fig. 3, {} localization: mean error in m", name(start)),
            fig3_table(results, start));
  }
  for (const Start start : results.experiment().config.starts) {
    section(fmt::format("Spread of the same errors, {} localization", name(start)),
            spread_table(results, start));
    section(fmt::format("Mean error in m at each image, {} localization", name(start)),
            image_table(results, start));
    section(fmt::format("The map's distortion after the last image, {} localization", name(start)),
            distortion_table(results, start));
    section(fmt::format("One idea off or on at a time, {} localization", name(start)),
            ablation_table(results, start));
  }
  section(fmt::format("Images until the error stays below {:g} m", kLocalizedWithin_m),
          localized_table(results));
  text += "\n## Settings\n\n```\n" + describe(results.experiment().config) + "```\n";
  return text;
}

}  // namespace semview::paper2017
