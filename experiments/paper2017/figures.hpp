// SPDX-License-Identifier: Apache-2.0
/// The paper's figures from the experiment's results, as SVG.
#pragma once

#include <filesystem>

#include "results.hpp"
#include "semview/core/result.hpp"

namespace semview::paper2017 {

/// Fig. 2: the plan of the first world as drawn, and as the strongest scaling and shear leave it:
/// `fig2_scale_1.5.svg`, `fig2_shear_0.5.svg`.
/// @errors those of drawing and loading plans; kUnavailable: cannot be written.
Status write_fig2(const Results& results, const std::filesystem::path& directory);

/// Fig. 3, left: distances of best particle, weighted mean and mean of all particles a image, for
/// odometry's heading and the compass. Nothing without such drives.
Status write_fig3(const Results& results, const std::filesystem::path& directory);

/// Fig. 4: a panel a row with boxes of weighted's and ours' errors a image and odometry's mean;
/// `fig4_local.svg`, `fig4_global.svg`.
Status write_fig4(const Results& results, const std::filesystem::path& directory);

}  // namespace semview::paper2017
