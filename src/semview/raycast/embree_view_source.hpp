// SPDX-License-Identifier: Apache-2.0
/// Views of grid cells, cast by Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "semview/core/thread_pool.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/view/view_source.hpp"

namespace semview::raycast {

/// Name and version of the engine in cache keys. The version is raised only when the views of
/// tests/raycast/golden_views_test.cpp change.
inline constexpr std::string_view kEngineName = "embree";
inline constexpr std::uint32_t kEngineVersion = 1;

/// Casts every requested cell anew, from its centre at yaw 0, several cells at once.
///
/// Knows nothing of the rule for cells whose eye is inside something (docs/conventions.md): every
/// cell gets the view of its own centre. All origins count as `cast`; a repeated cell is cast
/// again. The views do not depend on the number of threads.
class EmbreeViewSource final : public ViewSource {
 public:
  /// `ground_height_m` is the map's; `pool` must outlive the source.
  /// @errors kInvalidArgument: see `validate(const ViewProfile&)`.
  static Result<std::unique_ptr<EmbreeViewSource>> create(std::shared_ptr<const Scene> scene,
                                                          const ViewProfile& profile,
                                                          double ground_height_m,
                                                          ThreadPool& pool);

  const ViewProfile& profile() const override { return profile_; }
  /// @errors none
  Result<ViewBatch> views(std::span<const CellIndex> cells) override;

 private:
  EmbreeViewSource(std::shared_ptr<const Scene> scene,
                   const ViewProfile& profile,
                   double ground_height_m,
                   ThreadPool& pool);

  std::shared_ptr<const Scene> scene_;
  ViewProfile profile_;
  double eye_z_m_;
  ThreadPool* pool_;
};

}  // namespace semview::raycast
