// SPDX-License-Identifier: Apache-2.0
/// What a server tells of itself and of its maps, in the words of the domain.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "semview/core/hash.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/pose_grid.hpp"
#include "semview/semantics/class_table.hpp"
#include "semview/view/view_profile.hpp"

namespace semview::protocol {

/// The version in every header; a server answers any other with `kUnimplemented`.
inline constexpr std::uint32_t kProtocolVersion = 1;

struct MapSummary {
  std::string id;
  std::string name;
  Fingerprint fingerprint;

  bool operator==(const MapSummary&) const = default;
};

struct MapDescription {
  MapSummary summary;
  ClassTable classes;
  std::vector<std::optional<Rgb>> colors;  ///< one a class
  double ground_height_m = 0.0;
  ViewProfile profile;
  std::string engine;
  std::uint32_t engine_version = 0;
  std::string engine_reason;          ///< why this engine serves the map
  std::vector<CellIndex> free_cells;  ///< row by row
  std::string glb;                    ///< binary glTF, if it was asked for
  std::string weights_csv;            ///< the map's own weight matrix; empty: it has none

  bool operator==(const MapDescription&) const = default;
};

enum class JobState : std::uint8_t {
  kQueued = 1,
  kRunning = 2,
  kDone = 3,
  kFailed = 4,
  kCancelled = 5
};

/// How far a long job of the server is.
struct JobProgress {
  std::string job_id;
  std::string map_id;
  JobState state = JobState::kQueued;
  std::uint64_t total_cells = 0;
  std::uint64_t found_cells = 0;  ///< stored by an earlier run
  std::uint64_t cast_cells = 0;   ///< by this one
  double elapsed_s = 0.0;
  double remaining_s = 0.0;    ///< estimate; 0 until something was cast
  std::optional<Error> error;  ///< `kFailed`: why
};

}  // namespace semview::protocol
