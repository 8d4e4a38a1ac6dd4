// SPDX-License-Identifier: Apache-2.0
/// Observations and scores as messages.
#pragma once

#include <cstddef>
#include <string>

#include "semview/core/result.hpp"
#include "semview/v1/scores.pb.h"
#include "semview/view/observation.hpp"
#include "semview/view/score_source.hpp"

namespace semview::protocol {

/// The observation's part of the message: classes, size, labels and stamp.
void to_wire(const Observation& observation, v1::SetObservationRequest* wire);
/// The classes of a request, the rest of what all its images have in common checked.
/// @errors kInvalidArgument: class names empty, repeated or too many, a stamp that is not finite;
/// the field is named.
Result<ClassTable> classes_from_wire(const v1::SetObservationRequest& wire);
/// The panorama. @errors as above; kInvalidArgument: labels of another size
Result<Observation> from_wire(const v1::SetObservationRequest& wire);

/// The request's part of the message: poses, mode, curve, affines (which must be in range).
void to_wire(const ScoreRequest& request, v1::ScoreRequest* wire);
/// @errors those of poses with field "poses"; kInvalidArgument: an unknown mode, a curve without
/// the compass, affines that are not one a pose or out of range.
Result<ScoreRequest> from_wire(const v1::ScoreRequest& wire, std::size_t max_poses);

v1::ScoreReply to_wire(const ScoreBatch& batch);
/// @errors kDataLoss: not an answer to `request`.
Result<ScoreBatch> from_wire(const v1::ScoreReply& wire, const ScoreRequest& request);

}  // namespace semview::protocol
