// SPDX-License-Identifier: Apache-2.0
/// The experiment's recordings as run logs for other people's programs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "recording.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2023 {

struct ExportConfig {
  std::vector<std::uint64_t> worlds = {1};
  int static_paths = 1;
  int changed_paths = 4;
  std::size_t threads = 0;  ///< 0: one a core
  WorldConfig world;
};

/// @errors kInvalidArgument: no world, one twice, or paths not in 0..100; the field is the option.
Status validate(const ExportConfig& config);

/// Image i, from 0, was taken at i / 2 seconds.
double stamp_s(std::size_t frame);

/// Writes for each world
///
///     input/world_W/survey/             depth/, labels_gt/, labels_rcnn/, poses.txt, odometry
///     input/world_W/{static,changed}_P/ the same without poses: where the robot was is the
///     question truth/world_W/NAME.tum
///
/// and `input/list.csv`, a line a recording. Labels in `frames.csv` are those of `labels_gt/`.
/// @param progress  called with how many recordings of how many are written
/// @errors those of `validate`; kAlreadyExists: `directory` holds an export; those of writing.
Status export_recordings(const ExportConfig& config,
                         const std::filesystem::path& directory,
                         const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace semview::paper2023
