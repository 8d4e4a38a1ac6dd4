// SPDX-License-Identifier: Apache-2.0
#include "methods.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace semview::paper2023 {

namespace {

std::vector<Method> make_methods() {
  using field::FieldCue;
  using enum Idea;
  std::vector<Method> methods = {
      {"sdf", FieldCue::kSdf, LabelSource::kGt},
      {"sem_gt", FieldCue::kSem, LabelSource::kGt},
      {"sem_rcnn", FieldCue::kSem, LabelSource::kRcnnLike},
      {"sdf_sem_gt", FieldCue::kSdfSem, LabelSource::kGt},
      {"sdf_sem_rcnn", FieldCue::kSdfSem, LabelSource::kRcnnLike},
  };
  const std::pair<const char*, std::vector<Idea>> ours[] = {
      {"", {kOutliers, kSigma, kMotion}},
      {"_no_outliers", {kSigma, kMotion}},
      {"_no_sigma", {kOutliers, kMotion}},
      {"_no_motion", {kOutliers, kSigma}},
  };
  for (const auto& [suffix, ideas] : ours) {
    for (const LabelSource labels : {LabelSource::kGt, LabelSource::kRcnnLike}) {
      methods.push_back({fmt::format("ours_{}{}", name(labels), suffix),
                         FieldCue::kSdfSem,
                         labels,
                         ideas,
                         fmt::format("sdf_sem_{}", name(labels))});
    }
  }
  return methods;
}

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> kMethods = make_methods();
  return kMethods;
}

std::vector<Method> default_methods() {
  std::vector<Method> methods;
  for (const Method& method : all_methods()) {
    if (method.ideas.empty() || method.ideas.size() == 3) methods.push_back(method);
  }
  return methods;
}

const Method* find_method(std::string_view id) {
  const auto found = std::ranges::find(all_methods(), id, &Method::id);
  return found == all_methods().end() ? nullptr : &*found;
}

FilterConfig configured(const Method& method, FilterConfig config) {
  config.model.cue = method.cue;
  for (const Idea idea : method.ideas) {
    switch (idea) {
      case Idea::kOutliers:
        config.model.outlier = 0.2;
        break;
      case Idea::kSigma:
        config.model.sigma_sdf_m = 1.0;
        config.model.sigma_sem_m = 1.0;
        break;
      case Idea::kMotion:
        config.motion = {0.03, 0.02, 0.03, 0.01};
        break;
    }
  }
  return config;
}

std::string describe(const FilterConfig& config) {
  return fmt::format(
      "filter: {} particles; z {:g}/{:g}, sigma {:g} m and {:g} m; product to the power {:g}\n"
      "motion: alpha {:g} {:g} {:g} {:g}\n"
      "converged after {:g} m; failed above {:g} m\n",
      config.particles,
      config.model.z_sdf,
      config.model.z_sem,
      config.model.sigma_sdf_m,
      config.model.sigma_sem_m,
      config.temper,
      config.motion.alpha1,
      config.motion.alpha2,
      config.motion.alpha3,
      config.motion.alpha4,
      config.converged_after_m,
      config.failed_above_m);
}

}  // namespace semview::paper2023
