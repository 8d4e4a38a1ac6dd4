// SPDX-License-Identifier: Apache-2.0
#include "semview/segmentation/panorama_observer.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/segmentation/crops.hpp"
#include "semview/segmentation/stitching.hpp"

namespace semview::segmentation {
namespace {

PanoramaCamera whole_sphere(const PanoramaObserverConfig& config) {
  return {config.columns, config.columns / 2, -kPi / 2.0, kPi / 2.0};
}

template <typename T>
Image<T> cut_rows(const Image<T>& image, int first, int end) {
  if (image.empty()) return {};
  Image<T> cut(end - first, image.columns());
  for (int r = first; r < end; ++r) std::ranges::copy(image.row(r), cut.row(r - first).begin());
  return cut;
}

/// Leaves out the rows above and below what is seen.
Result<ObservedPanorama> cut_to_seen(const CameraRig& rig,
                                     const PanoramaCamera& sphere,
                                     const Segmentation& stitched,
                                     const RgbImage& photo) {
  const auto shows = [&stitched](int row) {
    return std::ranges::any_of(stitched.confidence.row(row), [](std::uint8_t c) { return c > 0; });
  };
  int first = 0;
  int end = sphere.rows;
  while (first < end && !shows(first)) ++first;
  while (end > first && !shows(end - 1)) --end;
  if (first == end) return fail(ErrorCode::kInvalidArgument, "no camera of the rig shows anything");
  const double row_rad = kPi / sphere.rows;
  ObservedPanorama observed;
  observed.camera.columns = sphere.columns;
  observed.camera.rows = end - first;
  observed.camera.elevation_max_rad = sphere.elevation_max_rad - first * row_rad;
  observed.camera.elevation_min_rad = sphere.elevation_max_rad - end * row_rad;
  observed.camera.position_m = rig.eye_m();
  observed.segmentation = {cut_rows(stitched.labels, first, end),
                           cut_rows(stitched.confidence, first, end)};
  observed.photo = cut_rows(photo, first, end);
  return observed;
}

template <typename T>
Result<std::vector<RigCamera>> cameras_for(const CameraRig& rig, std::span<const Image<T>> images) {
  if (images.size() != rig.cameras.size()) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format(
            "{} images, expected {}, one a camera of the rig", images.size(), rig.cameras.size()));
  }
  std::vector<RigCamera> cameras;
  for (std::size_t i = 0; i < images.size(); ++i) {
    Result<RigCamera> sized = of_size(rig.cameras[i].camera, images[i].rows(), images[i].columns());
    if (!sized) {
      return with_context(
          std::move(sized),
          fmt::format("image {} of {} ({})", i + 1, images.size(), rig.cameras[i].name));
    }
    cameras.push_back(*std::move(sized));
  }
  return cameras;
}

/// What the network is shown: photographs as they are, or their crops.
struct Picture {
  Photo photo;
  Image<std::uint8_t> seen;  ///< empty: all of it
};

std::vector<Picture> pictures_of(const std::vector<Photo>& photos) {
  std::vector<Picture> pictures;
  for (const Photo& photo : photos) {
    if (!is_too_wide(photo.camera)) {
      pictures.push_back({photo, {}});
      continue;
    }
    for (Crop& crop : level_crops(photo)) {
      pictures.push_back({std::move(crop.photo), std::move(crop.seen)});
    }
  }
  return pictures;
}

/// A crop's pixels that the photograph does not show have no voice.
void silence(const Image<std::uint8_t>& seen, Segmentation& segmentation) {
  for (std::size_t i = 0; i < seen.pixels().size(); ++i) {
    if (seen.pixels()[i] != 0) continue;
    segmentation.labels.pixels()[i] = kUnknown;
    segmentation.confidence.pixels()[i] = 0;
  }
}

}  // namespace

Status validate(const PanoramaObserverConfig& config) {
  if (config.columns < 4 || config.columns > kMaxObservedColumns || config.columns % 2 != 0) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("{} columns, expected an even number from 4 to {}",
                                  config.columns,
                                  kMaxObservedColumns),
                      "columns"});
  }
  return {};
}

Observation ObservedPanorama::observation(const ClassTable& classes,
                                          double stamp_s,
                                          const PanoramaCamera& profile) const {
  Observation made{
      classes, resample(segmentation.labels, camera, profile), stamp_s, base_from_eye(camera)};
  made.confidence = resample_confidence(
      segmentation.confidence, segmentation.labels, camera, profile, made.labels);
  return made;
}

Result<ObservedPanorama> observe(Segmenter& segmenter,
                                 const CameraRig& rig,
                                 std::span<const RgbImage> photos,
                                 const PanoramaObserverConfig& config,
                                 const NetworkProgress& progress) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY(std::vector<RigCamera> cameras, cameras_for(rig, photos));
  std::vector<Photo> taken;
  for (std::size_t i = 0; i < photos.size(); ++i) taken.push_back({cameras[i], photos[i]});
  const std::vector<Picture> pictures = pictures_of(taken);
  std::vector<SegmentedImage> segmented;
  for (const Picture& picture : pictures) {
    if (progress) progress(segmented.size(), pictures.size());
    SEMVIEW_TRY(Segmentation labels, segmenter.segment(picture.photo.image));
    silence(picture.seen, labels);
    segmented.push_back({picture.photo.camera, std::move(labels)});
  }
  const PanoramaCamera sphere = whole_sphere(config);
  return cut_to_seen(rig, sphere, stitch(segmented, sphere), stitch_photos(taken, sphere));
}

Result<ObservedPanorama> observe_labels(const CameraRig& rig,
                                        std::span<const LabelImage> labels,
                                        const PanoramaObserverConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config));
  SEMVIEW_TRY(std::vector<RigCamera> cameras, cameras_for(rig, labels));
  std::vector<SegmentedImage> segmented;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Segmentation sure{labels[i], Image<std::uint8_t>(labels[i].rows(), labels[i].columns(), 255)};
    for (std::size_t k = 0; k < labels[i].pixels().size(); ++k) {
      const ClassId label = labels[i].pixels()[k];
      if (label == kUnknown || label == kNoHit) sure.confidence.pixels()[k] = 0;
    }
    segmented.push_back({cameras[i], std::move(sure)});
  }
  const PanoramaCamera sphere = whole_sphere(config);
  return cut_to_seen(rig, sphere, stitch(segmented, sphere), {});
}

}  // namespace semview::segmentation
