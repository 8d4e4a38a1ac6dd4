// SPDX-License-Identifier: Apache-2.0
/// Pictures with known poses: read from a list, or simulated in another model of the building.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "photo_labels.hpp"
#include "semview/core/hash.hpp"
#include "semview/core/result.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/view/observation.hpp"

namespace semview::cli {

struct KnownPicture {
  std::string name;
  Pose2 map_from_robot;
  Observation observation;
};

/// Lines `picture,x_m,y_m,yaw_deg`; a first line of names, empty lines and lines that start with #
/// are skipped. A picture is, relative to the list's folder, the folder of an observation, or a
/// photograph, of a rig of several cameras their photographs in its order with `;` between them.
/// @param cells     of the map: every pose is over one of them
/// @param labeller  for photographs; null if nobody said how they are labelled
/// @errors kNotFound, kInvalidArgument with file and line; those of `io::read_observation` and
/// `PhotoLabeller::observe`.
Result<std::vector<KnownPicture>> read_picture_list(const std::filesystem::path& path,
                                                    const map::CellGrid& cells,
                                                    const PanoramaCamera& profile,
                                                    const PhotoLabeller* labeller);

struct SimulatedPictures {
  std::string world;            ///< a map whose views are photographed, a mesh mostly
  Fingerprint searched = {};    ///< of the map that the pictures are looked for in: another one
  double world_ground_m = 0.0;  ///< the storey's floor in the world's z
  double eye_height_m = 1.45;   ///< ± 5 cm, above that floor
  int pictures = 100;
  std::uint64_t seed = 1;
};

/// Photographs (`simulation::photograph`) taken at random places of free cells of the map, off the
/// grid, at random headings, by the world's own geometry and Embree.
/// @errors those of loading the world; kFailedPrecondition: it is the map that is searched, so that
/// finding its views there would prove nothing.
Result<std::vector<KnownPicture>> simulate_pictures(const SimulatedPictures& config,
                                                    const map::CellGrid& cells,
                                                    const PanoramaCamera& profile);

/// Only the part of a picture around its heading that a camera of this angle sees: the rest becomes
/// unknown. `turn_rad` turns the camera from the robot's heading.
Observation cropped(const Observation& observation, double turn_rad, double width_rad);

}  // namespace semview::cli
