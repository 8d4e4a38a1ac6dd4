// SPDX-License-Identifier: Apache-2.0
// OpenCV's matchTemplate as a peer: one correlation a map class gives the sums at every shift.
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "semview/benchmark/peer.hpp"
#include "semview/geometry/pose_grid.hpp"

namespace semview::benchmark {
namespace {

class TemplateMatcher final : public MatchPeer {
 public:
  explicit TemplateMatcher(const WeightImages& weights) {
    cv::setNumThreads(1);
    for (const Image<float>& image : weights) {
      cv::Mat mat(image.rows(), image.columns(), CV_32F);
      for (int r = 0; r < image.rows(); ++r) {
        for (int c = 0; c < image.columns(); ++c) mat.at<float>(r, c) = image.at(r, c);
      }
      weights_.push_back(mat);
    }
  }

  std::vector<float> headings(const LabelImage& view) const override {
    const int columns = view.columns();
    // A view turned by k columns starts k columns further left: twice the view holds every turn.
    cv::Mat twice(view.rows(), 2 * columns, CV_8U);
    for (int r = 0; r < view.rows(); ++r) {
      for (int c = 0; c < 2 * columns; ++c) {
        twice.at<unsigned char>(r, c) = view.at(r, c % columns);
      }
    }
    cv::Mat sums = cv::Mat::zeros(1, columns + 1, CV_32F);
    cv::Mat indicator;
    cv::Mat one;
    for (std::size_t map_class = 0; map_class < weights_.size(); ++map_class) {
      cv::Mat(twice == static_cast<double>(map_class)).convertTo(indicator, CV_32F, 1.0 / 255.0);
      cv::matchTemplate(indicator, weights_[map_class], one, cv::TM_CCORR);
      sums += one;
    }
    std::vector<float> headings(PoseGrid::kHeadings);
    for (int k = 0; k < PoseGrid::kHeadings; ++k) {
      const int shift = k * columns / PoseGrid::kHeadings;
      headings[static_cast<std::size_t>(k)] = sums.at<float>(0, (columns - shift) % columns);
    }
    return headings;
  }

 private:
  std::vector<cv::Mat> weights_;
};

}  // namespace
}  // namespace semview::benchmark

extern "C" __attribute__((visibility("default"))) semview::benchmark::MatchPeer*
semview_make_match_peer(const semview::benchmark::WeightImages& weights) {
  return new semview::benchmark::TemplateMatcher(weights);
}
