// SPDX-License-Identifier: Apache-2.0
/// Which model is to compare, as messages.
#pragma once

#include "semview/core/result.hpp"
#include "semview/v1/scores.pb.h"
#include "semview/view/score_model.hpp"

namespace semview::protocol {

v1::Model to_wire(ScoreModel model);
/// @errors kInvalidArgument, field `model`: none that this version knows.
Result<ScoreModel> from_wire(v1::Model wire);

/// The settings; of which model they are is said beside them.
void to_wire(const DepthScoring& scoring, v1::DepthScoring* wire);
/// @errors kInvalidArgument: out of range; the field is named.
Result<DepthScoring> from_wire(const v1::DepthScoring& wire, ScoreModel model);

}  // namespace semview::protocol
