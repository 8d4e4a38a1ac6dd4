// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/stitching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "semview/core/check.hpp"

namespace semview::segmentation {
namespace {

constexpr double kLeastVoice = 0.02;

/// The votes of the images that show one direction.
class Vote {
 public:
  void add(ClassId label, double voice, double confidence) {
    double& sum = sums_[label];
    if (sum == 0.0) labels_.push_back(label);
    sum += voice * confidence;
    voices_ += voice;
  }

  /// Writes the winner and is empty again.
  void count(ClassId& label, std::uint8_t& confidence) {
    if (labels_.empty()) return;
    std::ranges::sort(labels_);
    label =
        *std::ranges::max_element(labels_, std::less<>(), [this](ClassId id) { return sums_[id]; });
    confidence = static_cast<std::uint8_t>(std::lround(sums_[label] / voices_));
    for (const ClassId id : labels_) sums_[id] = 0.0;
    labels_.clear();
    voices_ = 0.0;
  }

 private:
  std::array<double, 256> sums_{};
  std::vector<ClassId> labels_;
  double voices_ = 0.0;
};

}  // namespace

Segmentation stitch(std::span<const SegmentedImage> images, const PanoramaCamera& panorama) {
  for (const SegmentedImage& image : images) {
    SEMVIEW_CHECK(image.segmentation.labels.rows() == rows_of(image.camera) &&
                  image.segmentation.labels.columns() == columns_of(image.camera) &&
                  image.segmentation.confidence.rows() == rows_of(image.camera) &&
                  image.segmentation.confidence.columns() == columns_of(image.camera));
  }
  Segmentation stitched{LabelImage(panorama.rows, panorama.columns, kUnknown),
                        Image<std::uint8_t>(panorama.rows, panorama.columns, 0)};
  Vote vote;
  for (int r = 0; r < panorama.rows; ++r) {
    for (int c = 0; c < panorama.columns; ++c) {
      const Eigen::Vector3d direction = panorama.direction(r, c);
      for (const SegmentedImage& image : images) {
        const std::optional<Eigen::Vector2d> pixel = pixel_of(image.camera, direction);
        if (!pixel) continue;
        const int row = static_cast<int>(pixel->y());
        const int column = static_cast<int>(pixel->x());
        const ClassId seen = image.segmentation.labels.at(row, column);
        // 0 in a label file of another program: nothing there, which no camera can know.
        const ClassId label = seen == kNoHit ? kUnknown : seen;
        const std::uint8_t confidence = image.segmentation.confidence.at(row, column);
        if (label == kUnknown && confidence == 0) continue;
        // A label that nobody vouches for still beats none at all.
        vote.add(label,
                 std::max(kLeastVoice, distance_to_border(image.camera, *pixel)),
                 std::max(1.0e-3, static_cast<double>(confidence)));
      }
      vote.count(stitched.labels.at(r, c), stitched.confidence.at(r, c));
    }
  }
  return stitched;
}

RgbImage stitch_photos(std::span<const Photo> photos, const PanoramaCamera& panorama) {
  RgbImage stitched(panorama.rows, panorama.columns);
  for (int r = 0; r < panorama.rows; ++r) {
    for (int c = 0; c < panorama.columns; ++c) {
      const Eigen::Vector3d direction = panorama.direction(r, c);
      double farthest = -1.0;
      for (const Photo& photo : photos) {
        const std::optional<Eigen::Vector2d> pixel = pixel_of(photo.camera, direction);
        if (!pixel) continue;
        const double distance = distance_to_border(photo.camera, *pixel);
        if (distance <= farthest) continue;
        farthest = distance;
        stitched.at(r, c) =
            photo.image.at(static_cast<int>(pixel->y()), static_cast<int>(pixel->x()));
      }
    }
  }
  return stitched;
}

}  // namespace semview::segmentation
