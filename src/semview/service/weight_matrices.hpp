// SPDX-License-Identifier: Apache-2.0
/// Weight matrices that were read before.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "semview/core/result.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::service {

/// A robot sends its matrix with every observation, and mostly it is the same text: reading one of
/// 150 × 11 weights takes as long as preparing the observation itself. The texts used last are kept
/// with what was read of them, compared in full.
/// @threads `read` from several threads at once.
class WeightMatrices {
 public:
  static constexpr std::size_t kMaxKept = 16;
  /// Longer texts are read each time.
  static constexpr std::size_t kMaxKeptBytes = std::size_t{1} << 20U;

  /// @errors those of similarity::parse_weight_matrix, with `name` for the text.
  Result<std::shared_ptr<const similarity::WeightMatrix>> read(const std::string& csv,
                                                               std::string_view name);

  std::size_t kept() const;

 private:
  struct Entry {
    std::string csv;
    std::shared_ptr<const similarity::WeightMatrix> matrix;
  };

  std::shared_ptr<const similarity::WeightMatrix> find(const std::string& csv);

  mutable std::mutex mutex_;
  std::list<Entry> entries_;  ///< the one used last first
};

}  // namespace semview::service
