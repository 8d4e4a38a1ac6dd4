// SPDX-License-Identifier: Apache-2.0
/// Who scores for `semview localize`: a map in this process, or a server.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "localize_options.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/score_source.hpp"

namespace semview::cli {

struct Scorer {
  std::shared_ptr<service::Site> site;  ///< what `source` stands on; null with a server
  std::unique_ptr<ScoreSource> source;
  std::vector<CellIndex> free_cells;  ///< where a robot may start
  std::string engine, engine_reason;  ///< what casts its views, and why
  std::string weights;                ///< where the weights come from, in words
};

/// Opens --map in this process or at --server. Views are scored with the weights for a log whose
/// classes are `observed`: --weights; else the map's own weights.csv if it speaks of all of them;
/// else the identity if the log's classes are the map's. Depth images need none.
Result<Scorer> open_scorer(const LocalizeOptions& options, const ClassTable& observed);

}  // namespace semview::cli
