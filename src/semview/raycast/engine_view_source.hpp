// SPDX-License-Identifier: Apache-2.0
/// Views of grid cells, cast by an engine.
#pragma once

#include <memory>

#include "semview/core/thread_pool.hpp"
#include "semview/raycast/engine.hpp"
#include "semview/view/view_source.hpp"

namespace semview::raycast {

/// Casts every requested cell anew, from its centre at yaw 0, several cells at once.
///
/// Knows nothing of the rule for cells whose eye is inside something (docs/conventions.md): every
/// cell gets the view of its own centre. All origins count as `cast`; a repeated cell is cast
/// again. The views do not depend on the number of threads.
class EngineViewSource final : public ViewSource {
 public:
  /// `ground_height_m` is the map's; `pool` must outlive the source.
  /// @errors kInvalidArgument: see `validate(const ViewProfile&)`.
  static Result<std::unique_ptr<EngineViewSource>> create(std::shared_ptr<const Engine> engine,
                                                          const ViewProfile& profile,
                                                          double ground_height_m,
                                                          ThreadPool& pool);

  const ViewProfile& profile() const override { return profile_; }
  /// @errors none
  Result<ViewBatch> views(std::span<const CellIndex> cells) override;
  /// @errors kInvalidArgument: an affine outside of its limits.
  Result<ViewBatch> undistorted_views(std::span<const CellIndex> cells,
                                      const MapAffine& affine) override;

 private:
  EngineViewSource(std::shared_ptr<const Engine> engine,
                   const ViewProfile& profile,
                   double ground_height_m,
                   ThreadPool& pool);

  std::shared_ptr<const Engine> engine_;
  ViewProfile profile_;
  double eye_z_m_;
  ThreadPool* pool_;
};

}  // namespace semview::raycast
