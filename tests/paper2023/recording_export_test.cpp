// SPDX-License-Identifier: Apache-2.0
#include "experiments/paper2023/recording_export.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::paper2023 {
namespace {

void say_nothing(std::size_t /*done*/, std::size_t /*all*/) {}

/// Small and short, but all of it.
ExportConfig small() {
  ExportConfig config;
  config.changed_paths = 1;
  config.world.camera.columns = 32;
  config.world.camera.rows = 24;
  config.world.drive.length_m = 2.0;
  config.world.drive.turn_rad = rad_from_deg(60.0);
  return config;
}

std::map<std::string, std::string> bytes_below(const std::filesystem::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    const auto text = io::read_text_file(entry.path(), std::size_t{1} << 24U);
    files[std::filesystem::relative(entry.path(), directory).string()] = text.value_or("unread");
  }
  return files;
}

TEST(RecordingExportTest, LogsHoldWhatWasRecordedAndNoTruth) {
  const testing::TemporaryFolder folder;
  const ExportConfig config = small();
  const Status exported = export_recordings(config, folder / "out", say_nothing);
  ASSERT_TRUE(exported) << exported.error().message;
  ThreadPool pool(1);
  const Recording recording = record_path(config.world, 1, Session::kChanged, 0, pool);
  const auto log = io::read_run_log(folder / "out/input/world_1/changed_0");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->frames.size(), recording.frames.size());
  for (const std::size_t i : {std::size_t{0}, recording.frames.size() - 1}) {
    EXPECT_EQ(*io::read_depth(*log, i), recording.frames[i].depth_m);
    EXPECT_EQ(*io::read_label_image(log->directory / log->frames[i].labels, log->setup.classes),
              recording.frames[i].labels_gt);
  }
  EXPECT_FALSE(log->groundtruth);
  EXPECT_FALSE(std::filesystem::exists(log->directory / "poses.txt"));
  const auto truth = io::read_tum(folder / "out/truth/world_1/changed_0.tum");
  ASSERT_TRUE(truth);
  EXPECT_NEAR(truth->back().pose.x_m, recording.frames.back().map_from_base.x_m, 1e-8);
}

TEST(RecordingExportTest, TheSurveyHasAMappersPoses) {
  const testing::TemporaryFolder folder;
  ExportConfig config = small();
  config.world.pose_noise.slow_position_m = 0.0;
  config.world.mount_error = {0.0, 0.0};
  ASSERT_TRUE(export_recordings(config, folder / "out", say_nothing));
  ThreadPool pool(1);
  const Recording survey = record_survey(config.world, 1, pool);
  const auto poses = io::read_tum_poses(folder / "out/input/world_1/survey/poses.txt");
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), survey.frames.size());
  EXPECT_TRUE((*poses)[3].pose.isApprox(survey.frames[3].map_from_camera, 1e-7));
  double squares = 0.0;
  for (const RecordedFrame& frame : survey.frames) {
    const Eigen::Isometry3d exact = map_from_base(frame.map_from_base) * survey.base_from_camera;
    squares += (frame.map_from_camera.translation() - exact.translation()).squaredNorm() / 3.0;
  }
  const auto count = static_cast<double>(survey.frames.size());
  // σ of 1 cm an axis, four standard errors; what drifts slowly has too few samples for this.
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 4.0 * 0.01 / std::sqrt(6.0 * count));
}

TEST(RecordingExportTest, ASeedGivesTheSameBytesForAnyNumberOfThreads) {
  const testing::TemporaryFolder folder;
  ExportConfig config = small();
  for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
    config.threads = threads;
    ASSERT_TRUE(export_recordings(config, folder / std::to_string(threads), say_nothing));
  }
  const auto one = bytes_below(folder / "1");
  EXPECT_GT(one.size(), 50U);
  EXPECT_EQ(one, bytes_below(folder / "3"));
}

TEST(RecordingExportTest, AnExportIsNotWrittenOver) {
  const testing::TemporaryFolder folder;
  ExportConfig config = small();
  config.static_paths = 0;
  config.changed_paths = 0;
  ASSERT_TRUE(export_recordings(config, folder / "out", say_nothing));
  const Status again = export_recordings(config, folder / "out", say_nothing);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kAlreadyExists);
  config.worlds = {2, 2};
  EXPECT_EQ(export_recordings(config, folder / "other", say_nothing).error().field, "--worlds");
}

}  // namespace
}  // namespace semview::paper2023
