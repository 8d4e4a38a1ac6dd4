// SPDX-License-Identifier: Apache-2.0
#include "semview/map/label_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace semview::map::detail {
namespace {

/// Unknown colours that get a line of their own: a smoothed drawing has thousands.
constexpr std::size_t kListedColors = 12;

struct ColorUse {
  Rgb color;
  std::size_t index = 0;  ///< the nearest entry of the palette
  bool exact = false;
  std::size_t pixels = 0;
  PixelIndex first;
};

int squared_distance(Rgb a, Rgb b) {
  const auto square = [](int x) { return x * x; };
  return square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
}

ColorUse nearest_entry(Rgb color, const std::vector<PaletteEntry>& palette, PixelIndex first) {
  ColorUse use{color, 0, false, 0, first};
  for (std::size_t i = 1; i < palette.size(); ++i) {
    if (squared_distance(color, palette[i].color) <
        squared_distance(color, palette[use.index].color)) {
      use.index = i;
    }
  }
  use.exact = palette[use.index].color == color;
  return use;
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
                               "the class with the nearest colour",
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
    }
  }
  uses.erase(std::remove_if(uses.begin(), uses.end(), [](const ColorUse& u) { return u.exact; }),
             uses.end());
  if (uses.empty()) return indices;
  if (nearest_colour) {
    report_taken(uses, file, report);
    return indices;
  }
  report_unknown(std::move(uses), palette, file, report);
  return std::nullopt;
}

}  // namespace semview::map::detail
