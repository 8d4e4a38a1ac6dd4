// SPDX-License-Identifier: Apache-2.0
#include "bench_load_findings.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace semview::cli {
using nlohmann::ordered_json;

void print_text(const LoadOptions& options, const LoadFindings& findings) {
  fmt::print("map {}, engine {} ({}), {}, {} cores\n",
             findings.map_id,
             findings.engine,
             findings.engine_reason,
             findings.threads == 0 ? "threads as the server has them"
                                   : fmt::format("{} server threads", findings.threads),
             findings.cores);
  fmt::print("{} load, {} cache, {:g} Hz a robot; times in ms from the intended start\n",
             options.kind,
             options.cold ? "cold" : "warm",
             options.load.rate_hz);
  fmt::print("{:>6} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}\n",
             "robots",
             "cycles",
             "answered",
             "in time",
             "refused",
             "failed",
             "lost",
             "p50",
             "p95",
             "p99",
             "max",
             "goodput/s");
  for (const auto& [robots, report] : findings.steps) {
    fmt::print(
        "{:>6} {:>7} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} "
        "{:>9.1f}\n",
        robots,
        report.cycles,
        report.answered,
        report.in_time,
        report.refused,
        report.failed,
        report.timed_out,
        report.p50_ms,
        report.p95_ms,
        report.p99_ms,
        report.max_ms,
        report.goodput_hz());
  }
  const client::KernelTime& kernel = findings.kernel;
  const double ceiling = findings.ceiling(options.load);
  fmt::print(
      "ceiling: {} cores / ({:g} Hz x ({:.2f} ms to prepare + {:.2f} ms to score)) = {:.0f} "
      "robots\n",
      findings.cores,
      options.load.rate_hz,
      kernel.prepare_ms,
      kernel.score_ms,
      ceiling);
  if (findings.most_robots == 0U && findings.settled) {
    fmt::print("held: fewer than {} robots with 99 of 100 answers within {} ms\n",
               findings.fewest_robots,
               options.load.in_time.count());
  } else if (findings.most_robots) {
    fmt::print("held: {}{} robots with 99 of 100 answers within {} ms, {:.0f} % of the ceiling\n",
               findings.settled ? "" : "at least ",
               *findings.most_robots,
               options.load.in_time.count(),
               100.0 * static_cast<double>(*findings.most_robots) / ceiling);
  }
}

void print_json(const LoadOptions& options, const LoadFindings& findings) {
  ordered_json json{
      {"map", findings.map_id},
      {"engine", findings.engine},
      {"engine_reason", findings.engine_reason},
      {"threads", findings.threads == 0 ? ordered_json(nullptr) : ordered_json(findings.threads)},
      {"load", options.kind},
      {"cold", options.cold},
      {"rate_hz", options.load.rate_hz},
      {"seconds", options.load.seconds},
      {"in_time_ms", options.load.in_time.count()},
      {"cores", findings.cores},
      {"prepare_ms", findings.kernel.prepare_ms},
      {"score_ms", findings.kernel.score_ms},
      {"ceiling_robots", findings.ceiling(options.load)},
      {"runs", ordered_json::array()}};
  for (const auto& [robots, report] : findings.steps) {
    json["runs"].push_back({{"robots", robots},
                            {"cycles", report.cycles},
                            {"answered", report.answered},
                            {"in_time", report.in_time},
                            {"refused", report.refused},
                            {"failed", report.failed},
                            {"timed_out", report.timed_out},
                            {"p50_ms", report.p50_ms},
                            {"p95_ms", report.p95_ms},
                            {"p99_ms", report.p99_ms},
                            {"max_ms", report.max_ms},
                            {"goodput_hz", report.goodput_hz()},
                            {"worst_start_ms", report.worst_start_ms}});
  }
  if (findings.most_robots) {
    json["most_robots"] = *findings.most_robots;
    json["fewest_tried"] = findings.fewest_robots;
    json["settled"] = findings.settled;
  }
  fmt::print("{}\n", json.dump(2));
}

}  // namespace semview::cli
