// SPDX-License-Identifier: Apache-2.0
/// Run logs with ground truth, made ready for the methods that `semview evaluate logs` compares.
#pragma once

#include <string>
#include <vector>

#include "experiments/paper2017/recordings.hpp"
#include "semview/core/result.hpp"
#include "semview/service/site.hpp"

namespace semview::cli {

struct ReadRecordings {
  std::vector<paper2017::Recording> recordings;
  ClassTable observed;             ///< the classes of all of them
  std::vector<std::string> notes;  ///< frames that are not compared, a line a log
};

/// Reads logs and labels; images are labelled by the network `segment`, unless it is empty. Frames
/// that have neither, or that odometry or ground truth do not cover, are skipped.
/// @errors kFailedPrecondition: a log without groundtruth.txt or without a frame to compare;
/// kInvalidArgument: two logs of one name or with other classes; those of `io::read_run_log`,
/// `io::read_frame` and `open_log_images`.
Result<ReadRecordings> read_recordings(const std::vector<std::string>& logs,
                                       const std::string& segment,
                                       const service::Site& site);

}  // namespace semview::cli
