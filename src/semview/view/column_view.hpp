// SPDX-License-Identifier: Apache-2.0
/// A panorama as runs: the form in which views are stored, sent and scored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/geometry/image.hpp"
#include "semview/geometry/panorama_camera.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview {

/// Class ids, orientation as in docs/conventions.md#panorama.
using LabelImage = Image<ClassId>;
/// Metres along the ray (panoramas) or along the optical axis (pinhole depth); +∞ where nothing is.
using RangeImage = Image<float>;

/// One class over the rows [previous run's end_row, end_row) of a column.
struct Run {
  std::uint16_t end_row = 0;
  ClassId label = kNoHit;

  bool operator==(const Run&) const = default;
};

/// The surface that a run's pixels lie on, as the eye sees it within one column: the range at
/// elevation ε is 1 / (a·cos ε + b·sin ε), exact for any plane. Upright walls have b = 0, level
/// floors and table tops a = 0; a = b = 0: the ray meets nothing.
struct RunPlane {
  float a_per_m = 0.0F;
  float b_per_m = 0.0F;

  bool operator==(const RunPlane&) const = default;
};

/// Surfaces nearer than this count as this far, so that a plane stays finite.
inline constexpr float kMinPlaneDistance_m = 1e-6F;

/// A panorama of `columns` × `rows` labels, each column a list of runs from top to bottom, with
/// ranges if it was made for a profile that asks for them (`ViewProfile::ranges`).
///
/// Canonical: neighbouring runs of a column differ in class or, with ranges, in plane; the last one
/// ends at `rows`. Equal label pictures have equal runs. A value is immutable once made and shared
/// between threads as `shared_ptr<const ColumnView>`.
class ColumnView {
 public:
  ColumnView() = default;

  /// The runs of a label image.
  static ColumnView from_labels(const LabelImage& labels);

  /// Takes runs as stored or received. `first_run` has columns + 1 entries: the runs of column c
  /// are [first_run[c], first_run[c + 1]). `planes`, for a view with ranges, has one entry a run.
  /// @errors kDataLoss: not canonical in the sense above; a plane that is not finite; a run of
  /// class 0 with a plane or one of another class without.
  static Result<ColumnView> from_runs(int rows,
                                      std::vector<std::uint32_t> first_run,
                                      std::vector<Run> runs,
                                      std::vector<RunPlane> planes = {});

  /// The same of runs that a renderer has made: they must be canonical, which only debug builds
  /// check.
  static ColumnView from_canonical_runs(int rows,
                                        std::vector<std::uint32_t> first_run,
                                        std::vector<Run> runs,
                                        std::vector<RunPlane> planes = {});

  /// The same labels without planes: neighbouring runs of a class become one.
  ColumnView without_ranges() const;

  /// The view whose column c is column `columns[c]` of this one; each below columns().
  ColumnView arranged(std::span<const std::uint32_t> columns) const;

  int columns() const { return first_run_.empty() ? 0 : static_cast<int>(first_run_.size()) - 1; }
  int rows() const { return rows_; }
  std::span<const Run> column(int c) const {
    const auto index = static_cast<std::size_t>(c);
    return std::span(runs_).subspan(first_run_[index], first_run_[index + 1] - first_run_[index]);
  }
  /// The planes of `column(c)`, or empty.
  std::span<const RunPlane> column_planes(int c) const {
    const auto index = static_cast<std::size_t>(c);
    if (planes_.empty()) return {};
    return std::span(planes_).subspan(first_run_[index], first_run_[index + 1] - first_run_[index]);
  }
  std::span<const Run> runs() const { return runs_; }
  std::span<const std::uint32_t> first_run() const { return first_run_; }
  bool has_ranges() const { return !planes_.empty(); }
  /// One entry a run of `runs()`, or empty.
  std::span<const RunPlane> planes() const { return planes_; }

  /// The pixels, turned to a heading of the PoseGrid; columns() must be a multiple of 120 unless
  /// `heading` is 0.
  LabelImage to_labels(int heading = 0) const;
  /// The ranges of a view that has them; `camera` is the one that it was cast for.
  RangeImage to_ranges(const PanoramaCamera& camera, int heading = 0) const;

  /// Memory held, for the byte budget of caches.
  std::size_t byte_size() const {
    return sizeof(ColumnView) + runs_.capacity() * sizeof(Run) +
           first_run_.capacity() * sizeof(std::uint32_t) + planes_.capacity() * sizeof(RunPlane);
  }

  bool operator==(const ColumnView&) const = default;

 private:
  static ColumnView assemble(int rows,
                             std::vector<std::uint32_t> first_run,
                             std::vector<Run> runs,
                             std::vector<RunPlane> planes);

  int rows_ = 0;
  std::vector<std::uint32_t> first_run_;
  std::vector<Run> runs_;
  std::vector<RunPlane> planes_;
};

using SharedView = std::shared_ptr<const ColumnView>;

}  // namespace semview
