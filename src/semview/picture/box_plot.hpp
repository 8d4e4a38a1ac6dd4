// SPDX-License-Identifier: Apache-2.0
/// Box plots in panels: how values spread at each of a few places.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"

namespace semview::picture {

struct PlotBox {
  double low_whisker = 0.0;
  double low_quartile = 0.0;
  double median = 0.0;
  double high_quartile = 0.0;
  double high_whisker = 0.0;
  std::vector<double> outliers;  ///< drawn as dots
};

struct BoxSeries {
  std::string name;  ///< in the legend; series of one name share its entry
  Rgb colour;
  std::vector<PlotBox> boxes;  ///< at places 1, 2, …
};

/// A line through values at the same places.
struct BoxCurve {
  std::string name;
  Rgb colour;
  std::vector<double> values;
};

struct BoxPanel {
  std::string title;
  std::vector<BoxSeries> series;
  std::vector<BoxCurve> curves;
};

struct BoxPlot {
  std::string title = {};
  std::string x_axis = {};  ///< "image"
  std::string y_axis = {};  ///< "m", at each y axis; from 0 to the highest whisker or curve
  bool same_scale = false;  ///< all panels to the highest of all, where they are to be compared
  std::vector<BoxPanel> panels = {};
  int panel_columns = 1;
};

/// @errors kInvalidArgument: nothing to draw; kUnavailable: the file cannot be written.
Status write_box_plot_svg(const std::filesystem::path& path, const BoxPlot& plot);

}  // namespace semview::picture
