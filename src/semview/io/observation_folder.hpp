// SPDX-License-Identifier: Apache-2.0
/// An observation as a folder: `observation.yaml`, `labels.png`, `confidence.png`. See
/// docs/formats/observation.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "semview/core/result.hpp"
#include "semview/io/yaml_document.hpp"
#include "semview/view/observation.hpp"
#include "semview/view/observation_resampler.hpp"

namespace semview::io {

/// What `observation.yaml` (of one observation) and `log.yaml` (of a run log) say alike.
struct ObservationSetup {
  ClassTable classes;        ///< the observer's vocabulary: pixel value 1 is its first name
  ObservationCamera camera;  ///< a panorama's rows and columns are those of its image, 0 here
};

/// Reads the keys `format`, `classes`, `panorama` or `pinhole`, and `base_from_camera` of
/// `document`; other keys are the caller's.
/// @errors kInvalidArgument with file and line.
Result<ObservationSetup> parse_observation_setup(const YamlNode& document);

/// The keys `format`, `panorama` or `pinhole`, and `base_from_camera` alone: of a run log whose
/// images have not been labelled.
/// @errors kInvalidArgument with file and line.
Result<ObservationCamera> parse_observation_camera(const YamlNode& document);

/// The keys of a setup as text that `parse_observation_setup` reads back.
std::string format_observation_setup(const ObservationSetup& setup);

/// The labels of a file as the camera took them (8-bit ids, 255 = unknown).
/// @errors those of read_png_grey; kInvalidArgument: an id past the class table, with its pixel.
Result<LabelImage> read_label_image(const std::filesystem::path& path, const ClassTable& classes);

/// Reads the label image `path` (8-bit ids, 255 = unknown) and resamples it to `profile`.
/// @errors those of read_png_grey; kInvalidArgument: a size other than the camera's, or an id past
/// the class table, with the first such pixel.
Result<Observation> read_labels(const std::filesystem::path& path,
                                const ObservationSetup& setup,
                                double stamp_s,
                                const PanoramaCamera& profile);

/// Reads the observation folder `directory` and resamples it to `profile`.
/// @errors kNotFound: a file is missing; kInvalidArgument: as above, with file and line or pixel.
Result<Observation> read_observation(const std::filesystem::path& directory,
                                     const PanoramaCamera& profile);

/// Writes an observation folder; `labels` are the camera's own pixels, not resampled, and
/// `confidence` is of their size, or empty.
/// @errors kInvalidArgument: labels of another size than a pinhole's; kUnavailable: cannot write.
Status write_observation(const std::filesystem::path& directory,
                         const ObservationSetup& setup,
                         const LabelImage& labels,
                         double stamp_s,
                         const Image<std::uint8_t>& confidence = {});

}  // namespace semview::io
