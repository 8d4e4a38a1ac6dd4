// SPDX-License-Identifier: Apache-2.0
#include "semview/map/label_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace semview::map::detail {
namespace {

/// Colours farther apart than this are not one colour and the noise of a compressed picture.
constexpr int kCloseDistance = 32;
/// How far smoothing reaches on either side of an edge.
constexpr int kBlurReach_px = 3;
/// Unknown colours that get a line of their own: a smoothed drawing has thousands.
constexpr std::size_t kListedColors = 12;

struct ColorUse {
  Rgb color;
  std::size_t index = 0;  ///< the nearest entry of the palette
  bool exact = false;
  bool close = false;  ///< hardly the blend of two others
  std::size_t pixels = 0;
  PixelIndex first;
};

int squared_distance(Rgb a, Rgb b) {
  const auto square = [](int x) { return x * x; };
  return square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
}

ColorUse nearest_entry(Rgb color, const std::vector<PaletteEntry>& palette, PixelIndex first) {
  ColorUse use{color, 0, false, false, 0, first};
  int nearest = std::numeric_limits<int>::max();
  int second = nearest;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const int distance = squared_distance(color, palette[i].color);
    if (distance < nearest) {
      second = std::exchange(nearest, distance);
      use.index = i;
    } else {
      second = std::min(second, distance);
    }
  }
  use.exact = nearest == 0;
  use.close = nearest <= kCloseDistance * kCloseDistance && 9 * nearest <= second;
  return use;
}

/// Gives pixels of unsure colours the nearest class among the sure pixels close by. The colour
/// between a table's and the floor's may be nearest to a wall's, but no wall stands there.
/// @param use_of  index into `uses` of every pixel.
void settle_by_neighbours(const RgbImage& labels,
                          const std::vector<PaletteEntry>& palette,
                          const std::vector<ColorUse>& uses,
                          const Image<std::uint32_t>& use_of,
                          Image<std::uint8_t>& indices) {
  // A smoothed drawing is exact but for its edges; a compressed one is exact almost nowhere.
  std::size_t exact_pixels = 0;
  for (const ColorUse& use : uses) exact_pixels += use.exact ? use.pixels : 0;
  const bool compressed = 2 * exact_pixels < labels.pixels().size();
  const auto sure = [&](int row, int column) {
    const ColorUse& use = uses[use_of.at(row, column)];
    return use.exact || (compressed && use.close);
  };
  const Image<std::uint8_t> first = indices;
  std::vector<bool> close_by(palette.size());
  // The pixels within `reach` rows and columns; true if one of them is sure.
  const auto look_around = [&](int row, int column, int reach) {
    std::fill(close_by.begin(), close_by.end(), false);
    bool found = false;
    for (int r = std::max(0, row - reach); r <= std::min(labels.rows() - 1, row + reach); ++r) {
      for (int c = std::max(0, column - reach); c <= std::min(labels.columns() - 1, column + reach);
           ++c) {
        if (!sure(r, c)) continue;
        found = close_by[first.at(r, c)] = true;
      }
    }
    return found;
  };
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      if (sure(row, column)) continue;
      int reach = 1;
      while (reach <= kBlurReach_px && !look_around(row, column, reach)) ++reach;
      if (reach > kBlurReach_px) continue;
      int nearest = std::numeric_limits<int>::max();
      for (std::size_t i = 0; i < palette.size(); ++i) {
        const int distance = squared_distance(labels.at(row, column), palette[i].color);
        if (!close_by[i] || distance >= nearest) continue;
        nearest = distance;
        indices.at(row, column) = static_cast<std::uint8_t>(i);
      }
    }
  }
}

std::string text_of(Rgb color) { return fmt::format("[{}, {}, {}]", color.r, color.g, color.b); }

void report_unknown(std::vector<ColorUse> unknown,
                    const std::vector<PaletteEntry>& palette,
                    const std::filesystem::path& file,
                    MapReport& report) {
  std::stable_sort(unknown.begin(), unknown.end(), [](const ColorUse& l, const ColorUse& r) {
    return l.pixels > r.pixels;
  });
  const std::size_t listed = std::min(unknown.size(), kListedColors);
  for (std::size_t i = 0; i < listed; ++i) {
    const ColorUse& use = unknown[i];
    MapProblem problem = file_problem(
        Severity::kError,
        file,
        fmt::format("colour {} of {} pixel{} is no class's",
                    text_of(use.color),
                    use.pixels,
                    use.pixels == 1 ? "" : "s"),
        fmt::format("nearest: {} {}", palette[use.index].name, text_of(palette[use.index].color)));
    problem.pixel = use.first;
    report.problems.push_back(std::move(problem));
  }
  if (listed == unknown.size()) return;
  std::size_t pixels = 0;
  for (std::size_t i = listed; i < unknown.size(); ++i) pixels += unknown[i].pixels;
  report.problems.push_back(file_problem(
      Severity::kError,
      file,
      fmt::format("{} more colours of {} pixels are no class's", unknown.size() - listed, pixels),
      "draw without smoothing (anti-aliasing), or take the nearest with --nearest-colour"));
}

void report_taken(const std::vector<ColorUse>& unknown,
                  const std::filesystem::path& file,
                  MapReport& report) {
  std::size_t pixels = 0;
  for (const ColorUse& use : unknown) pixels += use.pixels;
  report.problems.push_back(
      file_problem(Severity::kWarning,
                   file,
                   fmt::format("{} pixels of {} colours that are no class's were taken to be of "
                               "the class with the nearest colour close by",
                               pixels,
                               unknown.size())));
}

}  // namespace

std::optional<Image<std::uint8_t>> match_colors(const RgbImage& labels,
                                                const std::vector<PaletteEntry>& palette,
                                                bool nearest_colour,
                                                const std::filesystem::path& file,
                                                MapReport& report) {
  std::unordered_map<std::uint32_t, std::size_t> place_of;
  std::vector<ColorUse> uses;
  std::size_t last = 0;  // drawings are flat: the colour is mostly that of the pixel before
  Image<std::uint8_t> indices(labels.rows(), labels.columns());
  Image<std::uint32_t> use_of(labels.rows(), labels.columns());
  for (int row = 0; row < labels.rows(); ++row) {
    for (int column = 0; column < labels.columns(); ++column) {
      const Rgb color = labels.at(row, column);
      if (uses.empty() || uses[last].color != color) {
        const std::uint32_t packed = (std::uint32_t{color.r} << 16U) |
                                     (std::uint32_t{color.g} << 8U) | std::uint32_t{color.b};
        const auto [place, is_new] = place_of.emplace(packed, uses.size());
        if (is_new) uses.push_back(nearest_entry(color, palette, {row, column}));
        last = place->second;
      }
      ++uses[last].pixels;
      indices.at(row, column) = static_cast<std::uint8_t>(uses[last].index);
      use_of.at(row, column) = static_cast<std::uint32_t>(last);
    }
  }
  std::vector<ColorUse> unknown;
  std::ranges::copy_if(
      uses, std::back_inserter(unknown), [](const ColorUse& u) { return !u.exact; });
  if (unknown.empty()) return indices;
  if (nearest_colour) {
    report_taken(unknown, file, report);
    settle_by_neighbours(labels, palette, uses, use_of, indices);
    return indices;
  }
  report_unknown(std::move(unknown), palette, file, report);
  return std::nullopt;
}

}  // namespace semview::map::detail
