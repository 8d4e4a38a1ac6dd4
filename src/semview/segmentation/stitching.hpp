// SPDX-License-Identifier: Apache-2.0
/// Several images of one rig become one panorama, upright and turned to the robot's heading.
#pragma once

#include <span>

#include "semview/geometry/panorama_camera.hpp"
#include "semview/segmentation/rig_camera.hpp"
#include "semview/segmentation/segmenter.hpp"

namespace semview::segmentation {

/// An image's labels and what took it; both of one size.
struct SegmentedImage {
  RigCamera camera;
  Segmentation segmentation;
};

/// Looks up each pixel of `panorama` in every image that shows its direction (nearest pixel). Among
/// them the class c wins for which  Σ b · p(c) / Σ b  is largest: p(c) is an image's confidence
/// where its label is c, else 0, and b the distance to the image's border, where lenses and
/// networks are worst (at least 0.02, so that one image alone always speaks). That quotient is the
/// confidence. Of equal classes the lowest id wins. What no image shows is `kUnknown` with
/// confidence 0, and so is a pixel of an image that is unknown with confidence 0: it has no voice.
///
/// Only directions count: roll, pitch and yaw of the cameras are undone here, and nowhere else.
/// @cost O(panorama pixels · images)
Segmentation stitch(std::span<const SegmentedImage> images, const PanoramaCamera& panorama);

/// A photograph and what took it; both of one size.
struct Photo {
  RigCamera camera;
  RgbImage image;
};

/// The same of colours: of each pixel those of the image whose border is farthest; black where
/// none.
RgbImage stitch_photos(std::span<const Photo> photos, const PanoramaCamera& panorama);

}  // namespace semview::segmentation
