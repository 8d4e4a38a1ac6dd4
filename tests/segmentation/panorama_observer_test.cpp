// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/panorama_observer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "segmentation/colour_network.hpp"
#include "semview/segmentation/onnx_segmenter.hpp"

namespace semview::segmentation {
namespace {

using semview::testing::TemporaryFolder;
using testing::colour_of_channel;
using ::testing::HasSubstr;

/// Labels a pixel by its red value.
class RedSegmenter final : public Segmenter {
 public:
  const ClassTable& classes() const override { return classes_; }
  Result<Segmentation> segment(const RgbImage& image) override {
    ++pictures;
    Segmentation seen{LabelImage(image.rows(), image.columns()),
                      Image<std::uint8_t>(image.rows(), image.columns(), 200)};
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
      seen.labels.pixels()[i] = image.pixels()[i].r > 100 ? 1 : 2;
    }
    return seen;
  }
  int pictures = 0;

 private:
  ClassTable classes_{{"red", "other"}};
};

/// Red above the horizon.
RgbImage two_halves(int rows, int columns) {
  RgbImage image(rows, columns);
  for (int r = 0; r < rows / 2; ++r) {
    for (Rgb& pixel : image.row(r)) pixel = {200, 0, 0};
  }
  return image;
}

TEST(PanoramaObserverTest, AnEquirectangularPhotographIsSeenInSixLevelCrops) {
  RedSegmenter segmenter;
  std::vector<std::size_t> progress;
  const Result<ObservedPanorama> observed =
      observe(segmenter,
              equirectangular_rig(1.1),
              std::vector{two_halves(100, 200)},
              {},
              [&](std::size_t done, std::size_t total) { progress.push_back(10 * total + done); });
  ASSERT_TRUE(observed) << observed.error().message;
  EXPECT_EQ(segmenter.pictures, 6);
  EXPECT_EQ(progress, (std::vector<std::size_t>{60, 61, 62, 63, 64, 65}));
  // Squares of 100° reach 50° in their middle and 45.9° where two of them meet.
  EXPECT_NEAR(deg_from_rad(observed->camera.elevation_max_rad), 50.0, 0.51);
  EXPECT_EQ(observed->photo.rows(), observed->camera.rows);
  const PanoramaCamera profile{360, 90, -kPi / 4.0, kPi / 4.0};
  const Observation observation = observed->observation(segmenter.classes(), 3.5, profile);
  EXPECT_EQ(observation.stamp_s, 3.5);
  for (int c = 0; c < 360; ++c) {
    for (int r = 0; r < 90; ++r) {
      if (r == 44 || r == 45) continue;  // the photograph's own edge
      ASSERT_EQ(observation.labels.at(r, c), r < 45 ? 1 : 2) << r << ' ' << c;
      ASSERT_EQ(observation.confidence.at(r, c), 200);
    }
  }
}

TEST(PanoramaObserverTest, WhatAPartOfThePhotographDoesNotShowIsUnknown) {
  RedSegmenter segmenter;
  PartialPanorama ahead;
  ahead.azimuth_left_rad = rad_from_deg(50.0);
  ahead.azimuth_right_rad = rad_from_deg(-50.0);
  ahead.elevation_min_rad = rad_from_deg(-30.0);
  ahead.elevation_max_rad = rad_from_deg(30.0);
  const Result<ObservedPanorama> observed =
      observe(segmenter, rig_of(ahead), std::vector{two_halves(60, 100)});
  ASSERT_TRUE(observed) << observed.error().message;
  EXPECT_LT(segmenter.pictures, 6);
  EXPECT_NEAR(deg_from_rad(observed->camera.elevation_max_rad), 30.0, 0.51);
  const PanoramaCamera profile{360, 90, -kPi / 4.0, kPi / 4.0};
  const Observation observation = observed->observation(segmenter.classes(), 0.0, profile);
  EXPECT_EQ(observation.labels.at(30, 180), 1);
  EXPECT_EQ(observation.labels.at(60, 180), 2);
  EXPECT_EQ(observation.labels.at(30, 180 - 52), kUnknown);
  EXPECT_EQ(observation.labels.at(5, 180), kUnknown);
  EXPECT_EQ(observation.confidence.at(5, 180), 0);
}

TEST(PanoramaObserverTest, LabelsOfAnotherProgramAreSureWhereTheyAreKnown) {
  LabelImage labels(90, 180, 3);
  for (int c = 0; c < 90; ++c) {
    for (int r = 0; r < 90; ++r) labels.at(r, c) = kUnknown;
  }
  const Result<ObservedPanorama> observed =
      observe_labels(equirectangular_rig(1.2), std::vector{labels}, {.columns = 360});
  ASSERT_TRUE(observed) << observed.error().message;
  EXPECT_EQ(observed->camera.rows, 180);
  EXPECT_EQ(observed->segmentation.labels.at(90, 100), kUnknown);
  EXPECT_EQ(observed->segmentation.labels.at(90, 200), 3);
  EXPECT_EQ(observed->segmentation.confidence.at(90, 200), 255);
  EXPECT_TRUE(observed->photo.empty());
}

TEST(PanoramaObserverTest, WrongImagesSayWhichAndWhy) {
  RedSegmenter segmenter;
  EXPECT_THAT(observe(segmenter, equirectangular_rig(1.2), {}).error().message,
              HasSubstr("0 images, expected 1"));
  MountedPinhole mounted;
  EXPECT_THAT(
      observe(segmenter, rig_of(mounted), std::vector{RgbImage(480, 641)}).error().message,
      HasSubstr("image 1 of 1 (pinhole): 641 x 480 pixels, expected the camera's 640 x 480"));
  EXPECT_THAT(observe_labels(equirectangular_rig(1.2), std::vector{LabelImage(20, 40, kUnknown)})
                  .error()
                  .message,
              HasSubstr("no camera of the rig shows anything"));
  EXPECT_EQ(observe(segmenter, equirectangular_rig(1.2), {}, {.columns = 5}).error().field,
            "columns");
}

TEST(PanoramaObserverTest, A150ClassNetworkGoesAllTheWay) {
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (int k = 0; k < 150; ++k) names.push_back(fmt::format("class {}", k));
  const auto segmenter =
      OnnxSegmenter::load(testing::write_colour_network(folder, names, 128, 200.0));
  ASSERT_TRUE(segmenter) << segmenter.error().message;
  // Class 149 above the horizon, 77 below.
  MountedPinhole ahead;
  ahead.camera = {120, 90, 60.0, 60.0, 60.0, 45.0};
  ahead.base_from_camera = level_camera({}, 1.2);
  RgbImage photo(90, 120, colour_of_channel(149));
  for (int r = 45; r < 90; ++r) {
    for (Rgb& pixel : photo.row(r)) pixel = colour_of_channel(77);
  }
  const Result<ObservedPanorama> observed =
      observe(**segmenter, rig_of(ahead), std::vector{photo}, {.columns = 360});
  ASSERT_TRUE(observed) << observed.error().message;
  const PanoramaCamera profile{360, 90, -kPi / 4.0, kPi / 4.0};
  const Observation observation = observed->observation((*segmenter)->classes(), 0.0, profile);
  EXPECT_EQ(observation.labels.at(20, 180), 150);
  EXPECT_EQ(observation.labels.at(70, 180), 78);
  EXPECT_EQ(observation.labels.at(70, 20), kUnknown);
  EXPECT_EQ(observation.classes.name(observation.labels.at(70, 180)), "class 77");
}

}  // namespace
}  // namespace semview::segmentation
