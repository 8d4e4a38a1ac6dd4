// SPDX-License-Identifier: Apache-2.0
#include "storage_likelihoods.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "semview/view/view_model.hpp"

namespace semview::bench {
namespace {

/// In place of an encoder: counts the answers.
class AnswerCounter {
 public:
  static constexpr bool kDecodes = false;

  AnswerCounter(AnswerCounts& counts, double weight) : counts_(counts), weight_(weight) {}
  void count_for(const detail::ViewSituations& situations) { situations_ = &situations; }
  bool code(detail::AdaptiveBit& situation, bool yes) {
    const std::size_t place = situations_->place_of(situation);
    if (place < counts_.size()) (yes ? counts_[place].second : counts_[place].first) += weight_;
    return yes;
  }
  std::uint32_t code_plain(std::uint32_t value, unsigned /*count*/) { return value; }

 private:
  AnswerCounts& counts_;
  double weight_;
  const detail::ViewSituations* situations_ = nullptr;
};

}  // namespace

void count_answers(std::span<const std::vector<ColumnView>> blocks, AnswerCounts& counts) {
  AnswerCounter counter(counts, 1.0 / (64.0 * static_cast<double>(blocks.size())));
  for (const std::vector<ColumnView>& block : blocks) {
    for (const ColumnView& view : block) {
      detail::ColumnWalk walk(counter, view.columns(), view.rows(), false);
      counter.count_for(walk.situations());
      for (int c = 0; c < view.columns(); ++c) walk.code_column(view.column(c), {});
    }
  }
}

void print_likelihoods(const AnswerCounts& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto& [no, yes] = counts[i];
    const int of_256 = static_cast<int>(256.0 * (yes + 0.002) / (no + yes + 0.004));
    fmt::print("{}{},", i % 16 == 0 ? "\n    " : " ", std::clamp(of_256, 1, 254));
  }
  fmt::print("\n");
}

}  // namespace semview::bench
