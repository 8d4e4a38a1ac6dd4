// SPDX-License-Identifier: Apache-2.0
/// What the rows of the table are made of. Inside the module only.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "semview/benchmark/interleave.hpp"
#include "semview/benchmark/served_site.hpp"
#include "semview/benchmark/subject.hpp"
#include "semview/benchmark/table.hpp"

namespace semview::benchmark::detail {

/// How much is measured at a time.
struct Extent {
  std::size_t views = 8;              ///< cast a pass
  std::size_t slow_views = 2;         ///< of an alternative hundreds of times as slow
  std::size_t cells = 64;             ///< scored a pass
  std::size_t slow_cells = 4;         ///< of an alternative hundreds of times as slow
  std::size_t floor_cells = 100'000;  ///< of the posterior of a whole floor
  std::size_t stored_cells = 512;     ///< coded
  std::size_t precomputed_cells = 4096;
  std::size_t cold_cells = 20;      ///< asked for over TCP one by one
  std::size_t served_cells = 1000;  ///< asked for over TCP at once
  std::size_t served_poses = 2000;
  TurnsConfig turns = {};
};

struct Circumstances {
  const Subject& subject;
  PanoramaCamera camera;
  ThreadPool& pool;
  const Extent& extent;
  const std::string& engine;  ///< of rows that open a site
  const Serve& serve;         ///< may be empty: rows that need a server say so
};

/// Fills in a row's finding, or its note.
/// @errors Any: the results do not agree, or there are none.
using Measure = std::function<Status(const Circumstances&, Row&)>;

/// On which plans a row is worth its time.
enum class Plans { kAll, kDrawn, kFirst };

struct RowKind {
  std::string id;
  std::string claim;
  std::vector<Goal> goals;  ///< for panoramas of 360 columns and, if there are two, of 720
  Plans plans = Plans::kAll;
  bool one_thread_only = false;
  Measure measure;
};

std::vector<RowKind> cast_rows();
std::vector<RowKind> score_rows();
std::vector<RowKind> floor_rows();
std::vector<RowKind> storage_rows();
std::vector<RowKind> site_rows();
std::vector<RowKind> memory_rows();
std::vector<RowKind> served_rows();

Goal at_least(double ratio, std::optional<double> then = {});

/// Leaves a note in the row that a peer is not there (kNotFound); any other error is one.
Status without_peer(const Error& error, Row& row);

/// An item of work whose results are kept, as the program would: `make(i)` gives the i-th.
template <typename Made, typename Make>
Contender keeping(std::size_t items, std::vector<Made>& kept, const Make& make) {
  kept.resize(items);
  return {items, [&kept, make](std::size_t i) { kept[i] = make(i); }};
}

}  // namespace semview::benchmark::detail
