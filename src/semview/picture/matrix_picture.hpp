// SPDX-License-Identifier: Apache-2.0
/// A table of signed numbers as coloured squares.
#pragma once

#include <string>
#include <vector>

#include "semview/geometry/image.hpp"

namespace semview::picture {

struct MatrixPicture {
  std::string title = {};
  std::string row_axis = {};         ///< what rows are, in a word
  std::string column_axis = {};      ///< what columns are, in a word
  std::vector<std::string> rows;     ///< names, at the left
  std::vector<std::string> columns;  ///< names, on top, written upwards
  /// rows × columns; several stand in lines that fit a page, each with its name above.
  std::vector<Image<double>> values;
  std::vector<std::string> value_names;
};

/// Blue above zero, red below, white at it, the strongest colour at the largest value in size; the
/// number in each square, and the scale of colours below.
RgbImage draw_matrix(const MatrixPicture& picture);

}  // namespace semview::picture
