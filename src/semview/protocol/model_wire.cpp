// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/model_wire.hpp"

#include <utility>

#include <fmt/format.h>

#include "semview/protocol/envelope.hpp"

namespace semview::protocol {

v1::Model to_wire(ScoreModel model) {
  switch (model) {
    case ScoreModel::kViews:
      return v1::MODEL_VIEWS;
    case ScoreModel::kSdf:
      return v1::MODEL_SDF;
    case ScoreModel::kSem:
      return v1::MODEL_SEM;
    case ScoreModel::kSdfSem:
      return v1::MODEL_SDF_SEM;
  }
  return v1::MODEL_UNSPECIFIED;
}

Result<ScoreModel> from_wire(v1::Model wire) {
  if (wire == v1::MODEL_UNSPECIFIED) return ScoreModel::kViews;
  for (const auto& [model, unused] : kScoreModels) {
    if (to_wire(model) == wire) return model;
  }
  return wrong_field("model", fmt::format("{} is not a model", static_cast<int>(wire)));
}

void to_wire(const DepthScoring& scoring, v1::DepthScoring* wire) {
  wire->set_z_sdf(scoring.z_sdf);
  wire->set_sigma_sdf_m(scoring.sigma_sdf_m);
  wire->set_sigma_sem_m(scoring.sigma_sem_m);
  wire->set_by_movable(scoring.by_movable);
}

Result<DepthScoring> from_wire(const v1::DepthScoring& wire, ScoreModel model) {
  DepthScoring scoring;
  scoring.model = model;
  if (wire.has_z_sdf()) scoring.z_sdf = wire.z_sdf();
  if (wire.has_sigma_sdf_m()) scoring.sigma_sdf_m = wire.sigma_sdf_m();
  if (wire.has_sigma_sem_m()) scoring.sigma_sem_m = wire.sigma_sem_m();
  scoring.by_movable = wire.by_movable();
  // Written so that NaN fails.
  if (!(scoring.z_sdf >= 0.0 && scoring.z_sdf <= 1.0)) {
    return wrong_field("scoring.z_sdf", fmt::format("{:g}; expected 0 to 1", scoring.z_sdf));
  }
  for (const auto& [field, sigma_m] : {std::pair("scoring.sigma_sdf_m", scoring.sigma_sdf_m),
                                       std::pair("scoring.sigma_sem_m", scoring.sigma_sem_m)}) {
    if (!(sigma_m >= 0.01 && sigma_m <= 100.0)) {
      return wrong_field(field, fmt::format("{:g} m; expected 0.01 to 100", sigma_m));
    }
  }
  return scoring;
}

}  // namespace semview::protocol
