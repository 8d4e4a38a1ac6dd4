// SPDX-License-Identifier: Apache-2.0
#include "world_export.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "export_folder.hpp"
#include "guard.hpp"
#include "hand_matrix.hpp"
#include "raw_classes.hpp"
#include "row_map.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "semview/io/trajectory.hpp"
#include "semview/map/distorted_bundle.hpp"
#include "semview/map/distortion.hpp"
#include "trial.hpp"

namespace semview::paper2017 {
namespace {

namespace fs = std::filesystem;

std::vector<io::StampedPose2> stamped(const std::vector<Pose2>& poses) {
  const std::vector<double> stamps_s = stop_stamps_s();
  std::vector<io::StampedPose2> track;
  for (std::size_t i = 0; i < poses.size(); ++i) track.push_back({stamps_s[i], poses[i]});
  return track;
}

/// What the row's camera shows of a stop, in the camera's own pixels.
LabelImage narrowed(const LabelImage& labels, const PartialPanorama& camera, double width_rad) {
  LabelImage cut = labels;
  const double pixel_rad = (camera.azimuth_left_rad - camera.azimuth_right_rad) / cut.columns();
  for (int column = 0; column < cut.columns(); ++column) {
    const double azimuth_rad = camera.azimuth_left_rad - (column + 0.5) * pixel_rad;
    if (std::abs(azimuth_rad) <= width_rad / 2.0) continue;
    for (int row = 0; row < cut.rows(); ++row) cut.at(row, column) = kUnknown;
  }
  return cut;
}

Status write_log(const World& world, const Row& row, const fs::path& directory) {
  const io::ObservationSetup setup{raw_classes(), world.camera};
  SEMVIEW_TRY(io::RunLogWriter log,
              io::RunLogWriter::create(directory, setup, "semview evaluate paper2017 --export"));
  const std::vector<double> stamps_s = stop_stamps_s();
  std::vector<Pose2> odometry;
  for (std::size_t i = 0; i < world.stops.size(); ++i) {
    odometry.push_back(world.stops[i].odom_from_robot);
    SEMVIEW_TRY_STATUS(log.add_frame(
        stamps_s[i], narrowed(world.stops[i].labels, world.camera, row.field_of_view_rad)));
  }
  return log.finish(stamped(odometry), {});
}

class Exporter {
 public:
  Exporter(fs::path directory, similarity::WeightMatrix hand)
      : directory_(std::move(directory)), plans_(directory_ / "plans"), hand_(std::move(hand)) {}

  /// A row on a world; its line of the list is kept.
  Status write(const World& world, std::uint64_t seed, const Row& row) {
    const fs::path place = fs::path(row.id) / fmt::format("world_{}", seed);
    const fs::path input = directory_ / "input" / place;
    SEMVIEW_TRY_STATUS(write_map(world.layout, seed, row, false, input / "map"));
    SEMVIEW_TRY_STATUS(write_map(world.layout, seed, row, true, input / "map_stacked"));
    SEMVIEW_TRY_STATUS(write_log(world, row, input / "log"));
    const std::vector<io::StampedPose2> truth = stamped(true_poses(world, row));
    SEMVIEW_TRY_STATUS(io::write_tum(input / "start.tum", {truth.data(), 1}));
    const fs::path track = track_file(row.id, seed);
    std::error_code ignored;
    fs::create_directories((directory_ / "truth" / track).parent_path(), ignored);
    list_ += fmt::format("{0},{1},{2}/map,{2}/map_stacked,{2}/log,{2}/start.tum,{3}\n",
                         row.id,
                         seed,
                         place.string(),
                         track.string());
    return io::write_tum(directory_ / "truth" / track, truth);
  }

  Status finish() const {
    std::error_code ignored;
    fs::remove_all(plans_, ignored);
    return io::write_text_file(directory_ / "input" / "list.csv", list_);
  }

 private:
  Status write_map(const Layout& layout,
                   std::uint64_t seed,
                   const Row& row,
                   bool stacked,
                   const fs::path& directory) const {
    const fs::path plan = plan_directory(plans_, seed, row.classes, stacked);
    if (!fs::exists(plan)) {
      SEMVIEW_TRY_STATUS(draw_world_plan(layout, seed, row.classes, stacked, plans_));
      SEMVIEW_TRY_STATUS(io::write_text_file(
          plan / "weights.csv", row_weights(hand_, WeightsKind::kHand, row.classes).to_csv()));
    }
    std::error_code ignored;
    fs::create_directories(directory.parent_path(), ignored);
    return map::write_distorted(plan, row.affine, directory);
  }

  fs::path directory_;
  fs::path plans_;  ///< undistorted, while exporting
  similarity::WeightMatrix hand_;
  std::string list_ = "row,world,map,map_stacked,log,start,estimate\n";
};

Status check(const ExperimentConfig& config) {
  // Nobody's results: worlds that a method may learn from are given away as well.
  const bool training = std::ranges::all_of(config.worlds, [](std::uint64_t world) {
    return world >= kFirstTrainingWorld && world <= kLastTrainingWorld;
  });
  if (!training) {
    if (const auto use = check_worlds(config.worlds); !use) return fail(use.error());
  }
  return {};
}

}  // namespace

std::vector<double> stop_stamps_s() {
  std::vector<double> stamps_s;
  for (int stop = 1; stop <= kStops; ++stop) stamps_s.push_back(stop);
  return stamps_s;
}

std::filesystem::path track_file(const std::string& row, std::uint64_t world) {
  return fs::path(row) / fmt::format("world_{}.tum", world);
}

std::vector<Pose2> true_poses(const World& world, const Row& row) {
  std::vector<Pose2> poses;
  for (const Stop& stop : world.stops) {
    poses.push_back(map::distort(stop.map_from_robot, row.affine));
  }
  return poses;
}

Status export_worlds(const ExperimentConfig& config,
                     const std::filesystem::path& directory,
                     const std::function<void(std::size_t, std::size_t)>& progress) {
  SEMVIEW_TRY(const std::vector<Row> rows, rows_of(config));
  SEMVIEW_TRY_STATUS(check(config));
  SEMVIEW_TRY(const ExportFolder folder, ExportFolder::begin(directory));
  SEMVIEW_TRY(similarity::WeightMatrix hand,
              similarity::parse_weight_matrix(kHandMatrix, "the built-in matrix"));
  Exporter exporter(folder.unfinished(), std::move(hand));
  std::size_t done = 0;
  for (const std::uint64_t seed : config.worlds) {
    const World world = make_world(config.world, WorldSeeds::all(seed));
    for (const Row& row : rows) {
      SEMVIEW_TRY_STATUS(exporter.write(world, seed, row));
      progress(++done, rows.size() * config.worlds.size());
    }
  }
  SEMVIEW_TRY_STATUS(exporter.finish());
  return folder.finish();
}

}  // namespace semview::paper2017
