// SPDX-License-Identifier: Apache-2.0
#include "methods.hpp"

#include <algorithm>

namespace semview::paper2017 {
namespace {

std::vector<Method> make_methods() {
  Method weighted{.id = "weighted", .title = "weighted matrix, visual compass"};
  Method identity = weighted;
  identity.id = "identity";
  identity.title = "identity matrix, visual compass";
  identity.weights = WeightsKind::kIdentity;
  Method odometry_heading = weighted;
  odometry_heading.id = "weighted_odometry";
  odometry_heading.title = "weighted matrix, odometry heading";
  odometry_heading.heading = localization::HeadingStrategy::kOdometry;
  Method combined = weighted;
  combined.id = "combined";
  combined.title = "weighted matrix, combined heading";
  combined.heading = localization::HeadingStrategy::kCombined;
  combined.compass_gain = 1.0;
  Method stacked = combined;
  stacked.id = "stacked";
  stacked.title = "weighted matrix, combined heading, stacked plan, strongest mode";
  stacked.stacked_plan = true;
  stacked.estimate = localization::EstimateKind::kStrongestMode;
  Method learned = stacked;
  learned.id = "learned";
  learned.title = "learned weights, combined heading, stacked plan, strongest mode";
  learned.weights = WeightsKind::kLearned;
  learned.weighting.transform = observation::WeightTransform::kExponential;
  learned.weighting.kappa = 20.0;
  Method ours = learned;
  ours.id = "ours";
  ours.title = "as learned, with the map's distortion in the state";
  ours.affine = localization::AffineStateConfig{};
  ours.motion.sigma_m = 0.06;
  ours.motion.sigma_per_m = 0.08;
  return {identity, weighted, odometry_heading, combined, stacked, learned, ours};
}

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> kMethods = make_methods();
  return kMethods;
}

const Method* find_method(std::string_view id) {
  const auto& methods = all_methods();
  const auto found = std::ranges::find(methods, id, &Method::id);
  return found == methods.end() ? nullptr : &*found;
}

std::string_view name(Start start) { return start == Start::kLocal ? "local" : "global"; }

}  // namespace semview::paper2017
