// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "semview/field/distance_field.hpp"
#include "semview/field/distance_transform.hpp"

namespace semview::field {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Things between two heights; of a surface both are the same.
struct Interval {
  double low_m = 0.0;
  double high_m = 0.0;

  auto operator<=>(const Interval&) const = default;

  double distance_m(double z_m) const { return std::max({low_m - z_m, z_m - high_m, 0.0}); }
};

/// Squared distances in the plane to what stands between two heights, m².
struct PlaneField {
  Interval interval;
  std::vector<float> squared_m2;
};

using ClassInterval = std::pair<ClassId, Interval>;

/// The slabs of a column and what of its ground and ceiling is seen.
std::vector<ClassInterval> things_of(const ColumnProfile& profile, const map::ColumnMap& plan) {
  std::vector<ClassInterval> things;
  if (profile.outside) return things;
  for (const Slab& slab : profile.slabs) {
    things.emplace_back(slab.label, Interval{slab.z_min_m, slab.z_max_m});
  }
  const double ground_m = plan.ground_height_m;
  if (profile.ground != kNoHit &&
      (profile.slabs.empty() || profile.slabs.front().z_min_m > ground_m)) {
    things.emplace_back(profile.ground, Interval{ground_m, ground_m});
  }
  if (plan.ceiling &&
      (profile.slabs.empty() || profile.slabs.back().z_max_m < plan.ceiling->height_m)) {
    things.emplace_back(plan.ceiling->label,
                        Interval{plan.ceiling->height_m, plan.ceiling->height_m});
  }
  return things;
}

class PlanDistances final : public DistanceField {
 public:
  PlanDistances(const map::ColumnMap& plan, ClassTable classes, double cell_m, double margin_m)
      : classes_(std::move(classes)),
        ground_height_m_(plan.ground_height_m),
        margin_px_(static_cast<int>(std::ceil(margin_m / plan.resolution_m))) {
    const double edge_m = margin_px_ * plan.resolution_m;
    grid_.map_from_grid = plan.origin * Pose2{-edge_m, -edge_m, 0.0};
    grid_.cell_m = cell_m;
    grid_.columns = cells_over(plan.columns(), plan.resolution_m);
    grid_.rows = cells_over(plan.rows(), plan.resolution_m);
  }

  const ClassTable& classes() const override { return classes_; }
  const LayerGrid& grid() const override { return grid_; }
  double ground_height_m() const override { return ground_height_m_; }

  void sample_class(ClassId label, double z_m, std::span<float> squared_m2) const override {
    const auto found = class_fields_.find(label);
    sample(
        found == class_fields_.end() ? std::vector<PlaneField>{} : found->second, z_m, squared_m2);
  }
  void sample_surface(double z_m, std::span<float> squared_m2) const override {
    sample(surface_fields_, z_m, squared_m2);
  }

  /// @return false if the fields would be too large.
  bool add_fields(const map::ColumnMap& plan) {
    // Which profiles belong to which field; as class 0, to the surface of that interval.
    std::map<ClassInterval, std::vector<std::uint8_t>> profiles_of;
    for (std::size_t p = 0; p < plan.profiles.size(); ++p) {
      for (const auto& [label, interval] : things_of(plan.profiles[p], plan)) {
        for (const ClassId of : {label, kNoHit}) {
          std::vector<std::uint8_t>& in = profiles_of[{of, interval}];
          in.resize(plan.profiles.size());
          in[p] = 1;
        }
      }
    }
    if (profiles_of.size() * grid_.cells() > kMaxFieldCells) return false;
    for (const auto& [key, in] : profiles_of) {
      std::vector<PlaneField>& fields =
          key.first == kNoHit ? surface_fields_ : class_fields_[key.first];
      fields.push_back({key.second, plane_field(plan, in)});
    }
    return true;
  }

 private:
  int cells_over(int pixels, double resolution_m) const {
    return static_cast<int>(
        std::ceil((pixels + 2 * margin_px_) * resolution_m / grid_.cell_m - 1e-6));
  }

  std::vector<float> plane_field(const map::ColumnMap& plan,
                                 const std::vector<std::uint8_t>& profiles) const {
    Image<std::uint8_t> marked(plan.rows() + 2 * margin_px_, plan.columns() + 2 * margin_px_);
    for (int row = 0; row < plan.rows(); ++row) {
      for (int column = 0; column < plan.columns(); ++column) {
        // Row 0 of an image is the uppermost, of the grid the lowest.
        marked.at(plan.rows() - 1 - row + margin_px_, column + margin_px_) =
            profiles[plan.profile_of_pixel.at(row, column)];
      }
    }
    const Image<float> squared_px = squared_distances(marked);
    const double cells_to_px = grid_.cell_m / plan.resolution_m;
    const auto pixel_at = [cells_to_px](int cell, int pixels) {
      // Where the centre falls between two pixels, the right or upper one is taken.
      return std::min(static_cast<int>(std::floor((cell + 0.5) * cells_to_px + 1e-6)), pixels - 1);
    };
    const auto unit_m2 = static_cast<float>(plan.resolution_m * plan.resolution_m);
    std::vector<float> squared_m2;
    squared_m2.reserve(grid_.cells());
    for (int row = 0; row < grid_.rows; ++row) {
      const int y = pixel_at(row, squared_px.rows());
      for (int column = 0; column < grid_.columns; ++column) {
        squared_m2.push_back(squared_px.at(y, pixel_at(column, squared_px.columns())) * unit_m2);
      }
    }
    return squared_m2;
  }

  static void sample(const std::vector<PlaneField>& fields,
                     double z_m,
                     std::span<float> squared_m2) {
    std::ranges::fill(squared_m2, kInfinity);
    for (const PlaneField& field : fields) {
      const double dz_m = field.interval.distance_m(z_m);
      const auto dz_m2 = static_cast<float>(dz_m * dz_m);
      for (std::size_t i = 0; i < squared_m2.size(); ++i) {
        squared_m2[i] = std::min(squared_m2[i], field.squared_m2[i] + dz_m2);
      }
    }
  }

  ClassTable classes_;
  double ground_height_m_ = 0.0;
  int margin_px_ = 0;
  LayerGrid grid_;
  std::map<ClassId, std::vector<PlaneField>> class_fields_;
  std::vector<PlaneField> surface_fields_;
};

}  // namespace

Result<std::unique_ptr<DistanceField>> distances_of_plan(const map::ColumnMap& plan,
                                                         ClassTable classes,
                                                         double cell_m,
                                                         double margin_m) {
  if (!(cell_m >= plan.resolution_m && cell_m <= 1.0 && margin_m >= 0.0 && margin_m <= 100.0)) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("distances in cells of {} m, {} m beyond the map: expected the "
                            "resolution of {} m or more, and 0 to 100 m",
                            cell_m,
                            margin_m,
                            plan.resolution_m));
  }
  auto distances = std::make_unique<PlanDistances>(plan, std::move(classes), cell_m, margin_m);
  if (!distances->add_fields(plan)) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("distance fields of more than {} cells: choose larger cells", kMaxFieldCells));
  }
  return std::unique_ptr<DistanceField>(std::move(distances));
}

}  // namespace semview::field
