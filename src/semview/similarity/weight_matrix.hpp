// SPDX-License-Identifier: Apache-2.0
/// Which observed class speaks how much for which map class: w of equation (1). The file is
/// described in docs/formats/weights.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"
#include "semview/semantics/class_table.hpp"

namespace semview::similarity {

/// The name of the column for "the ray met nothing" (`kNoHit`).
inline constexpr std::string_view kNoneColumn = "none";

inline constexpr std::size_t kMaxWeightFileBytes = std::size_t{8} << 20U;
inline constexpr std::size_t kMaxElevationBands = 64;
/// A vocabulary's names and a map's.
inline constexpr std::size_t kMaxWeightRows = std::size_t{2} * kMaxClasses;

/// Rows = observed class names, columns = map class names (and `none`), one matrix for each band
/// of elevation; a matrix without bands has one from -90° to 90°.
///
/// Values are finite; hand-made matrices keep to [-1, 1]. Rows and columns that an observation or a
/// map does not use do no harm; one that it misses is an error (`check`).
///
/// @source Neubert et al. 2017, section III-C
class WeightMatrix {
 public:
  /// The weights of elevations in [min_deg, max_deg).
  struct Band {
    double elevation_min_deg = -90.0;
    double elevation_max_deg = 90.0;
    std::vector<double> weights;  ///< row-major, observed names × map names

    bool operator==(const Band&) const = default;
  };

  /// Names must be unique and not empty, bands apart from each other, each of the full size with
  /// finite weights.
  /// @errors kInvalidArgument otherwise.
  static Result<WeightMatrix> build(std::vector<std::string> observed_names,
                                    std::vector<std::string> map_names,
                                    std::vector<Band> bands);

  /// 1 where the names are the same, else 0: the baseline of the paper.
  static WeightMatrix identity(const ClassTable& observed, const ClassTable& map);
  static WeightMatrix identity(const ClassTable& classes) { return identity(classes, classes); }

  std::span<const std::string> observed_names() const { return observed_names_; }
  /// As in the file, `none` included where it has it.
  std::span<const std::string> map_names() const { return map_names_; }
  /// By rising elevation.
  std::span<const Band> bands() const { return bands_; }

  /// The weight in a band by position in `observed_names()` and `map_names()`.
  double weight(std::size_t band, std::size_t observed, std::size_t map) const {
    return bands_[band].weights[observed * map_names_.size() + map];
  }
  double max_abs_weight() const;

  /// @errors kFailedPrecondition: classes without a row or a column (`none` included); the message
  /// lists them all.
  Status check(const ClassTable& observed, const ClassTable& map) const;

  /// The CSV that `parse_weight_matrix` reads back to an equal matrix.
  std::string to_csv() const;

  bool operator==(const WeightMatrix&) const = default;

 private:
  WeightMatrix() = default;

  std::vector<std::string> observed_names_;
  std::vector<std::string> map_names_;
  std::vector<Band> bands_;
};

/// Reads CSV text; `name` stands before the line number in messages.
/// @errors kInvalidArgument: not such a table; kResourceExhausted: above the limits.
Result<WeightMatrix> parse_weight_matrix(std::string_view text, std::string_view name);

/// @errors as `parse_weight_matrix`; kNotFound: no such file.
Result<WeightMatrix> read_weight_matrix(const std::filesystem::path& path);

}  // namespace semview::similarity
