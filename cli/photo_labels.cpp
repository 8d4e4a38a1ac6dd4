// SPDX-License-Identifier: Apache-2.0
#include "photo_labels.hpp"

#include <utility>

#include "observe_options.hpp"
#include "semview/io/photo.hpp"
#include "semview/segmentation/panorama_observer.hpp"

namespace semview::cli {

Result<Observation> PhotoLabeller::observe(const std::vector<std::filesystem::path>& files,
                                           double stamp_s,
                                           const PanoramaCamera& profile) const {
  std::vector<RgbImage> photos;
  for (const std::filesystem::path& file : files) {
    SEMVIEW_TRY(RgbImage photo, io::read_photo(file));
    if (whole_sphere) {
      SEMVIEW_TRY_STATUS(check_whole_sphere(file.string(), photo.columns(), photo.rows()));
    }
    photos.push_back(std::move(photo));
  }
  SEMVIEW_TRY(const segmentation::ObservedPanorama seen,
              segmentation::observe(*segmenter, rig, photos));
  return seen.observation(segmenter->classes(), stamp_s, profile);
}

Result<PhotoLabeller> open_photo_labeller(const std::string& model, const std::string& camera) {
  PhotoLabeller labeller;
  // Where the camera stands above the floor is the search's to know, not the labels'.
  labeller.rig = segmentation::equirectangular_rig(ObserveOptions{}.eye_height_m);
  labeller.whole_sphere = camera.empty();
  if (!camera.empty()) {
    SEMVIEW_TRY(labeller.rig, segmentation::read_camera_rig(camera));
  }
  SEMVIEW_TRY(labeller.segmenter, open_segmenter(model));
  return labeller;
}

}  // namespace semview::cli
