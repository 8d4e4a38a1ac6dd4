// SPDX-License-Identifier: Apache-2.0
// Fusion beside Open3D's: the same frames and poses, the same voxels, and the depths of frames left
// out, cast from both meshes by the same engine.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "fusion_peer.hpp"
#include "semview/evaluation/depth_residuals.hpp"
#include "semview/evaluation/statistics.hpp"
#include "semview/field/volume_mesh.hpp"
#include "semview/io/run_log.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "usage.hpp"

namespace semview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMaxGap_s = 0.25;
constexpr const char* kUsage =
    "Usage: bench_fusion LOG [CHECK_EVERY [MIN_FRAMES]]\n"
    "Fuses the depth images of a run log here and by Open3D, one thread each, leaves every\n"
    "CHECK_EVERYth (10) out and compares it with what both meshes say; a surface here was seen by\n"
    "MIN_FRAMES (2) frames.";

struct Frames {
  std::vector<field::DepthFrame> fused;
  std::vector<field::DepthFrame> left_out;
};

Result<Frames> read_frames(const std::filesystem::path& directory, std::size_t check_every) {
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(directory));
  SEMVIEW_TRY(const std::vector<io::StampedPose3> poses,
              io::read_tum_poses(directory / "poses.txt"));
  const auto* mounted = std::get_if<MountedPinhole>(&log.setup.camera);
  if (mounted == nullptr) return fail(ErrorCode::kInvalidArgument, "the log has no pinhole");
  Frames frames;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    field::DepthFrame frame;
    frame.camera = mounted->camera;
    SEMVIEW_TRY(frame.map_from_camera, io::interpolate(poses, log.frames[i].stamp_s, kMaxGap_s));
    SEMVIEW_TRY(frame.depth_m, io::read_depth(log, i));
    auto& list = i % check_every == check_every / 2 ? frames.left_out : frames.fused;
    list.push_back(std::move(frame));
  }
  return frames;
}

Status report(const char* name,
              double elapsed_s,
              const map::TriangleMesh& mesh,
              const Frames& frames,
              double max_depth_m) {
  SEMVIEW_TRY(const raycast::Scene scene, raycast::Scene::build(mesh));
  evaluation::DepthResiduals residuals;
  for (const field::DepthFrame& frame : frames.left_out) {
    const auto view = raycast::render_pinhole(scene, {frame.map_from_camera, frame.camera});
    evaluation::add_residuals(frame.depth_m, view.depths_m, max_depth_m, residuals);
  }
  fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {} | {:.1f} |\n",
             name,
             1000.0 * residuals.median_m(),
             1000.0 * evaluation::quantile(residuals.errors_m, 0.9),
             100.0 * residuals.covered(),
             mesh.triangles.size(),
             1000.0 * elapsed_s / static_cast<double>(frames.fused.size()));
  return {};
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Status run(const std::filesystem::path& log, std::size_t check_every, float min_frames) {
  SEMVIEW_TRY(const Frames frames, read_frames(log, check_every));
  const field::VolumeShape shape;
  const field::FusionConfig config;
  fmt::print("{} frames fused, {} left out; voxels of {:g} m, truncation at {:g} m\n\n",
             frames.fused.size(),
             frames.left_out.size(),
             shape.voxel_m,
             shape.truncation_m);
  fmt::print("| | median error, mm | 90 %, mm | surface for, % | triangles | ms a frame |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  ThreadPool pool(1);
  field::SemanticVolume volume(shape, ClassTable({"surface"}));
  Clock::time_point start = Clock::now();
  for (const field::DepthFrame& frame : frames.fused) {
    SEMVIEW_TRY_STATUS(field::fuse(frame, config, pool, volume));
  }
  const double ours_s = seconds_since(start);
  SEMVIEW_TRY(const map::TriangleMesh mesh, field::mesh_of(volume, {min_frames}, pool));
  SEMVIEW_TRY_STATUS(report("semview", ours_s, mesh, frames, config.max_depth_m));
  const std::unique_ptr<bench::FusionPeer> open3d = bench::open3d_fusion(shape, config);
  if (!open3d) {
    fmt::print("| Open3D | not installed | | | | |\n");
    return {};
  }
  start = Clock::now();
  for (const field::DepthFrame& frame : frames.fused) open3d->add(frame);
  const double theirs_s = seconds_since(start);
  return report("Open3D", theirs_s, open3d->mesh(), frames, config.max_depth_m);
}

}  // namespace
}  // namespace semview

int main(int argc, char** argv) {
  if (const auto code = semview::bench::explain(argc, argv, semview::kUsage)) return *code;
  const std::span<char*> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments.size() > 3) {
    fmt::print(stderr, "{}\n", semview::kUsage);
    return 2;
  }
  const auto number = [&](std::size_t at, int otherwise) {
    return at < arguments.size() ? std::max(1, std::atoi(arguments[at])) : otherwise;
  };
  const semview::Status status = semview::run(
      arguments[0], static_cast<std::size_t>(number(1, 10)), static_cast<float>(number(2, 2)));
  if (status) return 0;
  fmt::print(stderr, "bench_fusion: {}\n", status.error().message);
  return 1;
}
