// SPDX-License-Identifier: Apache-2.0
#include "semview/service/field_likelihoods.hpp"

#include <algorithm>

#include "semview/field/field_likelihood.hpp"
#include "semview/field/map_distances.hpp"

namespace semview::service {

FieldLikelihoods::FieldLikelihoods(const map::SemanticMap& map) : map_(map) {}
FieldLikelihoods::~FieldLikelihoods() = default;

Result<std::shared_ptr<const field::FieldLikelihood>> FieldLikelihoods::of(
    const DepthScoring& scoring) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(kept_, scoring, &Kept::first);
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return found->second;
  }
  if (!distances_) distances_ = field::distances_of_map(map_);
  if (!*distances_) return fail(distances_->error());
  const std::shared_ptr<const field::DistanceField>& distances = **distances_;
  SEMVIEW_TRY(field::FieldLikelihood likelihood,
              field::FieldLikelihood::make(
                  distances, field::field_model(scoring, map_, distances->classes()), kSliceBytes));
  kept_.emplace_front(scoring,
                      std::make_shared<const field::FieldLikelihood>(std::move(likelihood)));
  if (kept_.size() > kKept) kept_.pop_back();
  return kept_.front().second;
}

}  // namespace semview::service
