// SPDX-License-Identifier: Apache-2.0
#include "semview/io/run_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace semview::io {
namespace {

using semview::testing::file_bytes;
using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

const PanoramaCamera kProfile{120, 30, rad_from_deg(-45.0), rad_from_deg(45.0)};
const ObservationSetup kSetup{ClassTable({"wall", "floor"}), PartialPanorama{}};
const std::vector<StampedPose2> kOdometry{{0.0, {}}, {1.0, {0.5, 0.0, 0.1}}};
const std::vector<StampedPose2> kTruth{{0.0, {3.0, 4.0, 1.0}}, {1.0, {3.5, 4.0, 1.1}}};

void write_log(const std::filesystem::path& directory) {
  Result<RunLogWriter> writer = RunLogWriter::create(directory, kSetup, "a \"test\"");
  ASSERT_TRUE(writer) << writer.error().message;
  ASSERT_TRUE(writer->add_frame(0.25, LabelImage(30, 120, 1)));
  ASSERT_TRUE(writer->add_frame(0.75, LabelImage(60, 240, 2)));
  ASSERT_TRUE(writer->finish(kOdometry, kTruth));
}

TEST(RunLogTest, ComesBackAsWritten) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  const Result<RunLog> log = read_run_log(folder / "log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->setup.classes, kSetup.classes);
  EXPECT_EQ(log->odometry.size(), 2U);
  ASSERT_TRUE(log->groundtruth);
  EXPECT_NEAR(log->groundtruth->back().pose.x_m, 3.5, 1e-9);
  ASSERT_EQ(log->frames.size(), 2U);
  EXPECT_EQ(log->frames[1].stamp_s, 0.75);
  const Result<Observation> frame = read_frame(*log, 1, kProfile);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->labels, LabelImage(30, 120, 2));
  EXPECT_EQ(frame->stamp_s, 0.75);
}

TEST(RunLogTest, EqualRunsMakeEqualBytes) {
  const TemporaryFolder folder;
  write_log(folder / "a");
  write_log(folder / "b");
  for (const char* name :
       {"log.yaml", "frames.csv", "odometry.txt", "groundtruth.txt", "labels/000001.png"}) {
    EXPECT_FALSE(file_bytes(folder / "a" / name).empty()) << name;
    EXPECT_EQ(file_bytes(folder / "a" / name), file_bytes(folder / "b" / name)) << name;
  }
}

TEST(RunLogTest, AFinishedLogIsNotWrittenOver) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  EXPECT_EQ(RunLogWriter::create(folder / "log", kSetup).error().code, ErrorCode::kAlreadyExists);
}

TEST(RunLogTest, AnUnfinishedFolderIsNoRunLog) {
  const TemporaryFolder folder;
  Result<RunLogWriter> writer = RunLogWriter::create(folder / "log", kSetup);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->add_frame(0.25, LabelImage(30, 120, 1)));
  EXPECT_EQ(read_run_log(folder / "log").error().code, ErrorCode::kNotFound);
}

TEST(RunLogTest, StampsMustIncrease) {
  const TemporaryFolder folder;
  Result<RunLogWriter> writer = RunLogWriter::create(folder / "log", kSetup);
  ASSERT_TRUE(writer->add_frame(1.0, LabelImage(1, 1, 1)));
  EXPECT_EQ(writer->add_frame(1.0, LabelImage(1, 1, 1)).error().code, ErrorCode::kInvalidArgument);
}

TEST(RunLogTest, GroundTruthMayBeMissing) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  std::filesystem::remove(folder / "log/groundtruth.txt");
  const Result<RunLog> log = read_run_log(folder / "log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_FALSE(log->groundtruth);
}

TEST(RunLogTest, FaultsInFramesNameFileAndLine) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  const auto message = [&](const std::string& lines) {
    folder.write("log/frames.csv", lines);
    const Result<RunLog> log = read_run_log(folder / "log");
    return log ? "no error" : log.error().message;
  };
  const std::string header = "timestamp,labels,depth,image\n";
  EXPECT_EQ(message(header + "0.5,labels/000000.png,,\r\n"), "no error");
  EXPECT_THAT(message("time,labels\n"), HasSubstr("frames.csv:1: expected the header"));
  EXPECT_THAT(message(header), HasSubstr("holds no frame"));
  EXPECT_THAT(message(header + "0.5,a.png\n"), HasSubstr("frames.csv:2: expected four columns"));
  EXPECT_THAT(message(header + "0.5,a,b,c,d\n"), HasSubstr("frames.csv:2: expected four columns"));
  EXPECT_THAT(message(header + "x,a,,\n"), HasSubstr("frames.csv:2: timestamp 'x'"));
  EXPECT_THAT(message(header + "2,a,,\n1,a,,\n"), HasSubstr("frames.csv:3: timestamp 1.0"));
  EXPECT_THAT(message(header + "1,../a,,\n"), HasSubstr("is not inside the log's folder"));
  EXPECT_THAT(message(header + "1,/etc/passwd,,\n"), HasSubstr("is not inside the log's folder"));
}

TEST(RunLogTest, AFrameWithoutLabelsIsNotFound) {
  const TemporaryFolder folder;
  write_log(folder / "log");
  folder.write("log/frames.csv", "timestamp,labels,depth,image\n0.5,,depth/0.png,\n");
  const Result<RunLog> log = read_run_log(folder / "log");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(read_frame(*log, 0, kProfile).error().code, ErrorCode::kNotFound);
}

/// A log of images: `yaml` is its log.yaml, `images` the image column of its one frame.
Result<RunLog> read_image_log(const TemporaryFolder& folder,
                              const std::string& yaml,
                              const std::string& images,
                              const std::string& labels = "") {
  write_log(folder / "log");
  folder.write("log/frames.csv",
               "timestamp,labels,depth,image\n0.5," + labels + ",," + images + "\n");
  folder.write("log/log.yaml", yaml);
  return read_run_log(folder / "log");
}

TEST(ImageLogTest, ALogWithoutLabelsNeedsNoClasses) {
  const TemporaryFolder folder;
  const std::string yaml =
      "format: 1\npinhole: {width: 4, height: 3, fx: 2, fy: 2, cx: 2, cy: 1.5}\n";
  const Result<RunLog> log = read_image_log(folder, yaml, "images/a.jpg");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(std::get<MountedPinhole>(log->setup.camera).camera.columns, 4);
  EXPECT_EQ(log->frames[0].images(), std::vector<std::string>{"images/a.jpg"});
  const TemporaryFolder labelled;
  EXPECT_THAT(read_image_log(labelled, yaml, "", "labels/000000.png").error().message,
              HasSubstr("'classes' is missing"));
}

TEST(ImageLogTest, ARigNamesWhatTookSeveralImages) {
  const TemporaryFolder folder;
  const std::string yaml = "format: 1\ncamera_rig: rig.yaml\n";
  const Result<RunLog> log = read_image_log(folder, yaml, "a.jpg;images/b.png");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->camera_rig, folder / "log/rig.yaml");
  EXPECT_EQ(log->frames[0].images(), (std::vector<std::string>{"a.jpg", "images/b.png"}));
  const auto error = [](const std::string& text, const char* images, const char* labels = "") {
    const TemporaryFolder other;
    return read_image_log(other, text, images, labels).error().message;
  };
  EXPECT_THAT(error(yaml, "a.jpg;../b.jpg"), HasSubstr("'../b.jpg' is not inside"));
  EXPECT_THAT(error("format: 1\ncamera_rig: /rig.yaml\n", "a"), HasSubstr("log.yaml:2: file"));
  EXPECT_THAT(error(yaml + "classes: [a]\n", "a"), HasSubstr("'classes' beside 'camera_rig'"));
  EXPECT_THAT(error(yaml, "a", "labels/000000.png"), HasSubstr("log.yaml:2: frames with labels"));
}

}  // namespace
}  // namespace semview::io
