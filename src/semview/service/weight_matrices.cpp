// SPDX-License-Identifier: Apache-2.0
#include "semview/service/weight_matrices.hpp"

#include <algorithm>
#include <utility>

namespace semview::service {

Result<std::shared_ptr<const similarity::WeightMatrix>> WeightMatrices::read(
    const std::string& csv, std::string_view name) {
  if (auto known = find(csv)) return known;
  SEMVIEW_TRY(similarity::WeightMatrix parsed, similarity::parse_weight_matrix(csv, name));
  auto matrix = std::make_shared<const similarity::WeightMatrix>(std::move(parsed));
  if (csv.size() > kMaxKeptBytes || find(csv) != nullptr) return matrix;
  const std::lock_guard lock(mutex_);
  entries_.push_front({csv, matrix});
  if (entries_.size() > kMaxKept) entries_.pop_back();
  return matrix;
}

std::shared_ptr<const similarity::WeightMatrix> WeightMatrices::find(const std::string& csv) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(entries_, [&csv](const Entry& entry) { return entry.csv == csv; });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return entries_.front().matrix;
}

std::size_t WeightMatrices::kept() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

}  // namespace semview::service
