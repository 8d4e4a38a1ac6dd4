// SPDX-License-Identifier: Apache-2.0
// What a plan that is ready and has answered takes of this machine's memory.
#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <malloc.h>

#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/subject_site.hpp"

namespace semview::benchmark::detail {
namespace {

/// A line of /proc/self/status, in MiB; 0 without it.
double status_mib(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024.0;
  }
  return 0.0;
}

/// Lets the peak begin anew at what is resident now.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

/// The rise of the process's peak from before a map is opened until some thousand of its cells have
/// been seen: what else this program holds is left out.
Status memory(const Circumstances& in, Row& row) {
  SEMVIEW_TRY(const ScratchFolder folder, ScratchFolder::make());
  SEMVIEW_TRY(const std::filesystem::path map, bundle_of(in.subject, folder));
  const std::vector<CellIndex> cells = in.subject.sample(in.extent.precomputed_cells);
  ::malloc_trim(0);  // or freed memory would be used anew, and not counted
  if (!forget_peak()) {
    row.note = "not installed: Linux with /proc/self/clear_refs";
    return {};
  }
  const double before = status_mib("VmRSS");
  SEMVIEW_TRY(const auto site, open_site(map, config_of(in), row));
  SEMVIEW_TRY_STATUS(site->views().views(cells).map([](auto&&) {}));
  const double peak = status_mib("VmHWM");
  Finding found;
  found.unit = std::string("MiB");
  found.ours = found.ours_median = std::max(0.0, peak - before);
  found.agreement = fmt::format("{}; after {} views; the process peaked at {:.0f} MiB",
                                site->engine().name,
                                cells.size(),
                                peak);
  row.found = std::move(found);
  return {};
}

}  // namespace

std::vector<RowKind> memory_rows() {
  // A GiB and the budget of the memory tier.
  return {{"memory",
           "memory of a plan that is ready and has answered",
           {{"at most 1536 MiB", 1536.0, std::nullopt, true, true}},
           Plans::kAll,
           true,
           memory}};
}

}  // namespace semview::benchmark::detail
