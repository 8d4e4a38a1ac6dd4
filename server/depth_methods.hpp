// SPDX-License-Identifier: Apache-2.0
/// Score and Heatmap of depth images.
#pragma once

#include <cstddef>
#include <memory>

#include "methods.hpp"
#include "semview/v1/scores.pb.h"
#include "semview/view/score_model.hpp"

namespace semview::field {
class FieldLikelihood;
class FieldObservation;
}  // namespace semview::field

namespace semview::server {

/// An observation made ready for a model of depth. @threads from several at once
struct DepthModel {
  std::shared_ptr<const field::FieldLikelihood> likelihood;
  std::shared_ptr<const field::FieldObservation> observation;
};

/// Poses of one chunk: one costs about as much as a cell of views, which is what plans are counted
/// in; with fewer, the observation's slices would be gone through for too little.
inline constexpr std::size_t kPosesPerChunk = 4 * kCellsPerChunk;

/// κ of probabilities where a request names none: the default of `semview localize`.
inline constexpr double kDepthKappa = 300.0;

/// @errors kFailedPrecondition: the observation came without depth, or depth cannot be scored on
/// this map; those of `field::FieldLikelihood::prepare`; all with field `model` or of `wire`.
Result<DepthModel> depth_model(Services& services,
                               const service::Site& site,
                               const service::StoredObservation& stored,
                               ScoreModel model,
                               const v1::DepthScoring& wire);

/// Of a Score request whose map and observation are found.
Result<Plan> plan_depth_score(Services& services,
                              const Request& request,
                              DepthModel model,
                              const v1::ScoreRequest& wire);

}  // namespace semview::server
