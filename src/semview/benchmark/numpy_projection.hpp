// SPDX-License-Identifier: Apache-2.0
/// The point projection in numpy, run in a process of its own. Inside the module only.
#pragma once

#include <vector>

#include "semview/benchmark/interleave.hpp"
#include "semview/benchmark/point_projection.hpp"
#include "semview/core/result.hpp"

namespace semview::benchmark::detail {

struct NumpyProjection {
  Timing time;  ///< of a view
  LabelImage first_view;
};

/// @param camera  Elevations from -45° to 45°.
/// @errors kNotFound: no script beside the program, or no Python with numpy; the message says how
/// to get them; kUnavailable: no temporary file.
Result<NumpyProjection> numpy_projection(const PointCloud& points,
                                         const std::vector<Eye>& eyes,
                                         const PanoramaCamera& camera,
                                         int rounds);

}  // namespace semview::benchmark::detail
