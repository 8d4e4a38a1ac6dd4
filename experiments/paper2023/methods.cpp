// SPDX-License-Identifier: Apache-2.0
#include "methods.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace semview::paper2023 {

const std::vector<Method>& all_methods() {
  using field::FieldCue;
  static const std::vector<Method> kMethods = {
      {"sdf", FieldCue::kSdf, LabelSource::kGt},
      {"sem_gt", FieldCue::kSem, LabelSource::kGt},
      {"sem_rcnn", FieldCue::kSem, LabelSource::kRcnnLike},
      {"sdf_sem_gt", FieldCue::kSdfSem, LabelSource::kGt},
      {"sdf_sem_rcnn", FieldCue::kSdfSem, LabelSource::kRcnnLike},
  };
  return kMethods;
}

const Method* find_method(std::string_view id) {
  const auto found = std::ranges::find(all_methods(), id, &Method::id);
  return found == all_methods().end() ? nullptr : &*found;
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
