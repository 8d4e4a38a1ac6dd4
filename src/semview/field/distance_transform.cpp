// SPDX-License-Identifier: Apache-2.0
#include "semview/field/distance_transform.hpp"

#include <algorithm>
#include <limits>

#include "semview/core/check.hpp"

namespace semview::field {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Distances along one line after another of at most `longest` cells.
class LineTransform {
 public:
  explicit LineTransform(int longest)
      : heights_(static_cast<std::size_t>(longest)),
        roots_(static_cast<std::size_t>(longest)),
        from_(static_cast<std::size_t>(longest) + 1) {}

  /// cells[i · stride] = min over j of cells[j · stride] + (i - j)², i and j in [0, count).
  void run(float* cells, int count, std::size_t stride) {
    const auto n = static_cast<std::size_t>(count);
    std::size_t parabolas = 0;
    for (std::size_t j = 0; j < n; ++j) {
      heights_[j] = cells[j * stride];
      if (heights_[j] == kInfinity) continue;
      double begin = -std::numeric_limits<double>::infinity();
      while (parabolas > 0) {
        begin = crossing(roots_[parabolas - 1], j);
        if (begin > from_[parabolas - 1]) break;
        --parabolas;
        begin = -std::numeric_limits<double>::infinity();
      }
      roots_[parabolas] = j;
      from_[parabolas] = begin;
      ++parabolas;
    }
    if (parabolas == 0) return;
    std::size_t k = 0;
    for (std::size_t i = 0; i < n; ++i) {
      while (k + 1 < parabolas && from_[k + 1] < static_cast<double>(i)) ++k;
      const float apart = static_cast<float>(i) - static_cast<float>(roots_[k]);
      cells[i * stride] = heights_[roots_[k]] + apart * apart;
    }
  }

 private:
  /// Where the parabola over j > i begins to be the lower one.
  double crossing(std::size_t i, std::size_t j) const {
    const auto a = static_cast<double>(i);
    const auto b = static_cast<double>(j);
    return ((static_cast<double>(heights_[j]) + b * b) -
            (static_cast<double>(heights_[i]) + a * a)) /
           (2.0 * (b - a));
  }

  std::vector<float> heights_;
  std::vector<std::size_t> roots_;
  std::vector<double> from_;
};

}  // namespace

std::vector<float> squared_distances(std::span<const std::uint8_t> marked, const Box& box) {
  SEMVIEW_CHECK(marked.size() == box.size());
  std::vector<float> cells(box.size());
  std::ranges::transform(
      marked, cells.begin(), [](std::uint8_t mark) { return mark != 0 ? 0.0F : kInfinity; });
  LineTransform line(std::max({box.nx, box.ny, box.nz, 1}));
  const std::size_t row = static_cast<std::size_t>(box.nx);
  const std::size_t layer = row * static_cast<std::size_t>(box.ny);
  for (int z = 0; z < box.nz; ++z) {
    for (int y = 0; y < box.ny; ++y) line.run(&cells[box.index(0, y, z)], box.nx, 1);
    for (int x = 0; x < box.nx; ++x) line.run(&cells[box.index(x, 0, z)], box.ny, row);
  }
  for (int y = 0; y < box.ny && box.nz > 1; ++y) {
    for (int x = 0; x < box.nx; ++x) line.run(&cells[box.index(x, y, 0)], box.nz, layer);
  }
  return cells;
}

Image<float> squared_distances(const Image<std::uint8_t>& marked) {
  const std::vector<float> cells =
      squared_distances(marked.pixels(), Box{marked.columns(), marked.rows(), 1});
  Image<float> distances(marked.rows(), marked.columns());
  std::ranges::copy(cells, distances.pixels().begin());
  return distances;
}

}  // namespace semview::field
