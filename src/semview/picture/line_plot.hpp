// SPDX-License-Identifier: Apache-2.0
/// Lines over two logarithmic axes, several panels side by side: how something grows.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::picture {

struct PlotLine {
  std::string name;  ///< in the legend; lines of one name share its entry
  Rgb colour;
  std::vector<std::array<double, 2>> points;  ///< x, y, both above 0
};

struct PlotPanel {
  std::string x_axis;  ///< "panorama, columns"
  std::vector<PlotLine> lines;
};

struct LinePlot {
  std::string title = {};
  std::string y_axis = {};  ///< of all panels: they have one scale
  std::vector<PlotPanel> panels = {};
};

/// @errors kInvalidArgument: nothing to draw; kUnavailable: the file cannot be written.
Status write_line_plot_svg(const std::filesystem::path& path, const LinePlot& plot);

}  // namespace semview::picture
