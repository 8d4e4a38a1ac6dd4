// SPDX-License-Identifier: Apache-2.0
// Ways to make a panorama.
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "semview/benchmark/agreement.hpp"
#include "semview/benchmark/measurement.hpp"
#include "semview/benchmark/numpy_projection.hpp"
#include "semview/benchmark/peer.hpp"
#include "semview/benchmark/plain_rays.hpp"
#include "semview/benchmark/point_projection.hpp"
#include "semview/raycast/column_renderer.hpp"

namespace semview::benchmark::detail {
namespace {

using raycast::Panorama;
using raycast::PanoramaRequest;

std::vector<PanoramaRequest> requests(const Circumstances& in, std::size_t count) {
  std::vector<PanoramaRequest> made;
  for (const CellIndex& cell : in.subject.sample(count)) {
    made.push_back(in.subject.request(cell, in.camera));
  }
  return made;
}

Panorama packets(const Subject& subject, const PanoramaRequest& request) {
  return raycast::render_panorama(*subject.scene, request);
}

/// Label runs with their planes: the form in which ranges are kept.
ColumnView column_runs(const Subject& subject, const PanoramaRequest& request) {
  return raycast::render_column_view(*subject.columns, request, true);
}

Panorama pixels_of(const Panorama& panorama, const PanoramaCamera& /*camera*/) { return panorama; }
/// Without ranges where the view has none.
Panorama pixels_of(const ColumnView& view, const PanoramaCamera& camera) {
  return {view.to_labels(), view.has_ranges() ? view.to_ranges(camera) : RangeImage()};
}

/// What two functions of a request see, then their times.
template <typename Ours, typename Other>
Status compare_casters(
    const Circumstances& in, Row& row, double ties, const Ours& ours, const Other& other) {
  const std::vector<PanoramaRequest> views = requests(in, in.extent.views);
  Agreement agreement(ties);
  for (const PanoramaRequest& view : views) {
    agreement.add(pixels_of(ours(view), in.camera), pixels_of(other(view), in.camera));
  }
  SEMVIEW_TRY_STATUS(agreement.check());
  std::vector<decltype(ours(views[0]))> our_views;
  std::vector<decltype(other(views[0]))> other_views;
  const Turns turns =
      take_turns(keeping(views.size(), our_views, [&](std::size_t i) { return ours(views[i]); }),
                 keeping(views.size(), other_views, [&](std::size_t i) { return other(views[i]); }),
                 in.pool,
                 in.extent.turns);
  row.found = finding_of(turns, agreement.text());
  return {};
}

Status runs_and_packets(const Circumstances& in, Row& row) {
  return compare_casters(
      in,
      row,
      kTiesOfEngines,
      [&](const PanoramaRequest& view) { return column_runs(in.subject, view); },
      [&](const PanoramaRequest& view) { return packets(in.subject, view); });
}

Status column_pixels_and_packets(const Circumstances& in, Row& row) {
  return compare_casters(
      in,
      row,
      kTiesOfEngines,
      [&](const PanoramaRequest& view) {
        return raycast::render_panorama(*in.subject.columns, view);
      },
      [&](const PanoramaRequest& view) { return packets(in.subject, view); });
}

Status label_runs_and_packets(const Circumstances& in, Row& row) {
  return compare_casters(
      in,
      row,
      kTiesOfEngines,
      [&](const PanoramaRequest& view) { return in.subject.runs(view); },
      [&](const PanoramaRequest& view) {
        return raycast::render_column_view(*in.subject.scene, view);
      });
}

Status packets_and_plain_rays(const Circumstances& in, Row& row) {
  const PlainRays loop(in.subject.mesh);
  const auto directions = directions_of(in.subject.request({0, 0}, in.camera));
  return compare_casters(
      in,
      row,
      kTiesOfPeers,
      [&](const PanoramaRequest& view) { return packets(in.subject, view); },
      [&](const PanoramaRequest& view) { return loop.cast(view, directions); });
}

/// The rays of a view as the peer takes them.
std::vector<float> rays_of(const PanoramaRequest& view) {
  const auto x = static_cast<float>(view.map_from_robot.x_m);
  const auto y = static_cast<float>(view.map_from_robot.y_m);
  const auto z = static_cast<float>(view.eye_z_m);
  std::vector<float> rays;
  for (const auto& direction : directions_of(view)) {
    rays.insert(rays.end(), {x, y, z});
    rays.insert(rays.end(), direction.begin(), direction.end());
  }
  return rays;
}

Panorama panorama_of(const CasterPeer& peer,
                     std::size_t image,
                     const Subject& subject,
                     const PanoramaCamera& camera) {
  Panorama panorama{
      LabelImage(camera.rows, camera.columns, kNoHit),
      RangeImage(camera.rows, camera.columns, std::numeric_limits<float>::infinity())};
  const std::vector<std::uint32_t> triangles = peer.triangles(image);
  const std::vector<float> parameters = peer.parameters(image);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= subject.mesh.labels.size()) continue;
    panorama.labels.pixels()[i] = subject.mesh.labels[triangles[i]];
    panorama.ranges_m.pixels()[i] = parameters[i];
  }
  return panorama;
}

/// `ours` beside Open3D on the same rays, made ready before the time is taken.
template <typename Ours>
Status compare_with_open3d(const Circumstances& in, Row& row, const Ours& ours) {
  auto peer = open_caster_peer(in.subject.mesh);
  if (!peer) return without_peer(peer.error(), row);
  const std::vector<PanoramaRequest> views = requests(in, in.extent.views);
  Agreement agreement(kTiesOfPeers);
  for (const PanoramaRequest& view : views) {
    const std::size_t image = (*peer)->add_rays(rays_of(view));
    (*peer)->cast(image);
    agreement.add(pixels_of(ours(view), in.camera),
                  panorama_of(**peer, image, in.subject, in.camera));
  }
  SEMVIEW_TRY_STATUS(agreement.check());
  std::vector<decltype(ours(views[0]))> our_views;
  const Turns turns =
      take_turns(keeping(views.size(), our_views, [&](std::size_t i) { return ours(views[i]); }),
                 {views.size(), [&](std::size_t i) { (*peer)->cast(i); }},
                 in.pool,
                 in.extent.turns);
  row.found = finding_of(turns, agreement.text());
  return {};
}

Status packets_and_open3d(const Circumstances& in, Row& row) {
  return compare_with_open3d(
      in, row, [&](const PanoramaRequest& view) { return packets(in.subject, view); });
}

Status columns_and_open3d(const Circumstances& in, Row& row) {
  return compare_with_open3d(
      in, row, [&](const PanoramaRequest& view) { return column_runs(in.subject, view); });
}

Eye eye_of(const PanoramaRequest& view) {
  return {static_cast<float>(view.map_from_robot.x_m),
          static_cast<float>(view.map_from_robot.y_m),
          static_cast<float>(view.eye_z_m)};
}

std::string share_text(const Agreement& agreement, const PointCloud& points) {
  return fmt::format("{:.1f} M points; {:.1f} % of labels as ray casting has them",
                     1e-6 * static_cast<double>(points.size()),
                     100.0 * agreement.same_share());
}

Status columns_and_points(const Circumstances& in, Row& row) {
  const PointCloud points = point_cloud(*in.subject.map->columns());
  const std::vector<PanoramaRequest> views = requests(in, in.extent.views);
  const std::size_t slow = std::min(in.extent.slow_views, views.size());
  const auto ours = [&](std::size_t i) { return in.subject.runs(views[i]); };
  const auto theirs = [&](std::size_t i) {
    return project_points(points, eye_of(views[i]), in.camera);
  };
  Agreement agreement(kTiesOfPeers);
  for (std::size_t i = 0; i < slow; ++i) agreement.add_labels(ours(i).to_labels(), theirs(i));
  std::vector<ColumnView> our_views;
  std::vector<LabelImage> other_views;
  const Turns turns = take_turns(keeping(views.size(), our_views, ours),
                                 keeping(slow, other_views, theirs),
                                 in.pool,
                                 in.extent.turns);
  row.found = finding_of(turns, share_text(agreement, points));
  return {};
}

Status columns_and_numpy(const Circumstances& in, Row& row) {
  const PointCloud points = point_cloud(*in.subject.map->columns());
  const std::vector<PanoramaRequest> views = requests(in, in.extent.views);
  std::vector<Eye> eyes;
  for (std::size_t i = 0; i < std::min(in.extent.slow_views, views.size()); ++i) {
    eyes.push_back(eye_of(views[i]));
  }
  const auto numpy = numpy_projection(points, eyes, in.camera, in.extent.turns.fewest_rounds);
  if (!numpy) return without_peer(numpy.error(), row);
  Agreement same(kTiesOfPeers);
  same.add_labels(project_points(points, eyes.front(), in.camera), numpy->first_view);
  // A point on the edge of a pixel falls to either side: their arc tangents differ in the last bit.
  if (same.same_share() < 0.999) {
    return fail(ErrorCode::kInternal, "results differ from the C++ projection: " + same.text());
  }
  std::vector<ColumnView> our_views;
  const Timing ours = time_alone(
      keeping(views.size(), our_views, [&](std::size_t i) { return in.subject.runs(views[i]); }),
      in.pool,
      in.extent.turns);
  row.found = finding_of({ours, numpy->time, in.extent.turns.fewest_rounds, clock_for(in.pool)},
                         "the C++ projection: " + same.text());
  row.note = "in turn with nothing: numpy has a process of its own";
  return {};
}

}  // namespace

std::vector<RowKind> cast_rows() {
  const auto row =
      [](std::string id, std::string claim, std::vector<Goal> goals, Plans plans, Measure measure) {
        return RowKind{std::move(id),
                       std::move(claim),
                       std::move(goals),
                       plans,
                       plans == Plans::kFirst,
                       std::move(measure)};
      };
  return {
      row("single",
          "Embree packets; a plain rtcIntersect1 loop",
          {at_least(3.4, 5.0), at_least(3.4, 5.0)},
          Plans::kAll,
          packets_and_plain_rays),
      row("open3d",
          "Embree packets; Open3D RaycastingScene",
          {at_least(4.0, 5.0), at_least(4.0, 5.0)},
          Plans::kAll,
          packets_and_open3d),
      row("columns",
          "columns, runs with ranges; Embree packets, ranges",
          {at_least(22.0, 60.0), at_least(30.0, 90.0)},
          Plans::kDrawn,
          runs_and_packets),
      row("pixels",
          "columns, pixels with ranges; Embree packets, ranges",
          {at_least(22.0, 60.0), at_least(30.0, 90.0)},
          Plans::kDrawn,
          column_pixels_and_packets),
      row("labels",
          "columns, label runs; Embree packets, label runs",
          {{}, {}},
          Plans::kDrawn,
          label_runs_and_packets),
      row("columns_open3d",
          "columns, runs with ranges; Open3D RaycastingScene",
          {at_least(50.0), at_least(100.0)},
          Plans::kDrawn,
          columns_and_open3d),
      row("points",
          "columns, label runs; the 2017 paper's point projection",
          {at_least(500.0, 1500.0), at_least(500.0, 1500.0)},
          Plans::kFirst,
          columns_and_points),
      row("numpy",
          "columns, label runs; the point projection in numpy",
          {at_least(2000.0)},
          Plans::kFirst,
          columns_and_numpy),
  };
}

}  // namespace semview::benchmark::detail
