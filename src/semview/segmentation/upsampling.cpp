// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/upsampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "semview/core/check.hpp"

namespace semview::segmentation {
namespace {

/// Logits this far behind the best add nothing to a confidence of 8 bits, even 254 of them
/// (254 · e^-16 < 3e-5); of 150 classes that is nearly all of them, and the exponential is what
/// costs.
constexpr float kNegligible = -16.0F;

/// Between which two source pixels a target pixel lies.
struct Tap {
  std::size_t low = 0;
  std::size_t high = 0;
  float share_of_high = 0.0F;
};

std::vector<Tap> taps(int source, int target) {
  std::vector<Tap> result(static_cast<std::size_t>(target));
  const double step = static_cast<double>(source) / target;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double at = std::clamp(
        (static_cast<double>(i) + 0.5) * step - 0.5, 0.0, static_cast<double>(source - 1));
    const double low = std::floor(at);
    result[i].low = static_cast<std::size_t>(low);
    result[i].high = std::min(result[i].low + 1, static_cast<std::size_t>(source - 1));
    result[i].share_of_high = static_cast<float>(at - low);
  }
  return result;
}

/// The best channel of each pixel of one target row.
class RowReducer {
 public:
  RowReducer(const ChannelPlanes& planes, const SegmentationModel& model, int columns)
      : planes_(planes),
        model_(model),
        taps_(taps(planes.columns, columns)),
        squeezed_(static_cast<std::size_t>(planes.columns)),
        values_(static_cast<std::size_t>(planes.channels) * taps_.size()),
        best_(taps_.size()),
        best_channel_(taps_.size()),
        sum_(taps_.size()) {}

  void reduce(const Tap& vertical, std::span<ClassId> labels, std::span<std::uint8_t> confidence) {
    const auto channels = static_cast<std::size_t>(planes_.channels);
    for (std::size_t k = 0; k < channels; ++k) {
      interpolate(k, vertical);
      take_better(k);
    }
    if (model_.output == NetworkOutput::kLogits) add_exponentials();
    for (std::size_t c = 0; c < taps_.size(); ++c) {
      const float probability = model_.output == NetworkOutput::kLogits ? 1.0F / sum_[c] : best_[c];
      labels[c] = model_.class_of_channel[best_channel_[c]];
      confidence[c] =
          static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(probability, 0.0F, 1.0F)));
    }
  }

 private:
  std::span<float> values(std::size_t channel) {
    return std::span(values_).subspan(channel * taps_.size(), taps_.size());
  }

  void interpolate(std::size_t channel, const Tap& vertical) {
    const std::size_t width = squeezed_.size();
    const auto plane =
        planes_.values.subspan(channel * width * static_cast<std::size_t>(planes_.rows),
                               width * static_cast<std::size_t>(planes_.rows));
    const auto above = plane.subspan(vertical.low * width, width);
    const auto below = plane.subspan(vertical.high * width, width);
    for (std::size_t c = 0; c < width; ++c) {
      squeezed_[c] = above[c] + (below[c] - above[c]) * vertical.share_of_high;
    }
    const std::span<float> row = values(channel);
    for (std::size_t c = 0; c < row.size(); ++c) {
      const Tap& tap = taps_[c];
      row[c] = squeezed_[tap.low] + (squeezed_[tap.high] - squeezed_[tap.low]) * tap.share_of_high;
    }
  }

  void take_better(std::size_t channel) {
    const std::span<const float> row = values(channel);
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (channel == 0 || row[c] > best_[c]) {
        best_[c] = row[c];
        best_channel_[c] = channel;
      }
    }
  }

  void add_exponentials() {
    std::ranges::fill(sum_, 0.0F);
    for (std::size_t k = 0; k < static_cast<std::size_t>(planes_.channels); ++k) {
      const std::span<const float> row = values(k);
      for (std::size_t c = 0; c < row.size(); ++c) {
        const float behind = row[c] - best_[c];
        if (behind > kNegligible) sum_[c] += std::exp(behind);
      }
    }
  }

  const ChannelPlanes& planes_;
  const SegmentationModel& model_;
  std::vector<Tap> taps_;
  std::vector<float> squeezed_;  ///< one channel's row between two source rows
  std::vector<float> values_;    ///< a target row a channel
  std::vector<float> best_;
  std::vector<std::size_t> best_channel_;
  std::vector<float> sum_;
};

}  // namespace

Segmentation best_classes(const ChannelPlanes& planes,
                          const SegmentationModel& model,
                          int rows,
                          int columns) {
  SEMVIEW_CHECK(planes.channels == static_cast<int>(model.channels.size()));
  SEMVIEW_CHECK(planes.values.size() == static_cast<std::size_t>(planes.channels) *
                                            static_cast<std::size_t>(planes.rows) *
                                            static_cast<std::size_t>(planes.columns));
  Segmentation result{LabelImage(rows, columns), Image<std::uint8_t>(rows, columns)};
  const std::vector<Tap> vertical = taps(planes.rows, rows);
  RowReducer reducer(planes, model, columns);
  for (int r = 0; r < rows; ++r) {
    reducer.reduce(
        vertical[static_cast<std::size_t>(r)], result.labels.row(r), result.confidence.row(r));
  }
  return result;
}

}  // namespace semview::segmentation
