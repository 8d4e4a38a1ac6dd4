// SPDX-License-Identifier: Apache-2.0
#include "fuse_check.hpp"

#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/raycast/scene.hpp"

namespace semview::cli {

Result<LeftOutFindings> check_left_out(const FuseFrames& frames,
                                       std::span<const std::size_t> left_out,
                                       const map::TriangleMesh& mesh,
                                       double max_depth_m) {
  SEMVIEW_TRY(const raycast::Scene scene, raycast::Scene::build(mesh));
  LeftOutFindings findings;
  for (const std::size_t index : left_out) {
    const Result<field::DepthFrame> frame = frames.read(index);
    if (!frame) continue;
    const raycast::PinholeRequest request{frame->map_from_camera, frame->camera};
    const bool fits = frame->depth_m.rows() == frame->camera.rows &&
                      frame->depth_m.columns() == frame->camera.columns;
    if (!fits || !raycast::validate(request)) continue;
    ++findings.frames;
    evaluation::add_residuals(frame->depth_m,
                              raycast::render_pinhole(scene, request).depths_m,
                              max_depth_m,
                              findings.residuals);
  }
  return findings;
}

}  // namespace semview::cli
