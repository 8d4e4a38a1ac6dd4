// SPDX-License-Identifier: Apache-2.0
#include "semview/field/field_likelihood.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "field/field_scene.hpp"
#include "reference/field_likelihood.hpp"
#include "semview/observation/voxel_reduction.hpp"

namespace semview::field {
namespace {

/// Against the printed equations, a pixel: what voxels and cells may cost at most.
constexpr double kFaithful = 0.005;

Pose2 standing_place() { return room().origin * Pose2{0.6, 1.1, 0.3}; }

/// The place from which the photograph was taken, poses near it, in the room and past its walls.
std::vector<Pose2> poses_to_score() {
  const Pose2 truth = standing_place();
  std::vector<Pose2> poses = {truth,
                              truth * Pose2{0.13, -0.08, 0.1},
                              truth * Pose2{0.9, 0.4, -1.2},
                              truth * Pose2{0.3, 0.0, 3.0},
                              truth * Pose2{-4.0, 7.0, 0.5}};
  return poses;
}

std::shared_ptr<const DistanceField> field_of_room() {
  return std::shared_ptr<const DistanceField>(
      *distances_of_plan(room(), room_classes(), 0.05, 1.0));
}

VoxelList voxels_of(const DepthObservation& seen) { return *observation::reduce(seen); }

FieldScores scores_of(std::shared_ptr<const DistanceField> field,
                      const FieldModelConfig& config,
                      const VoxelList& voxels,
                      const std::vector<Pose2>& poses,
                      std::size_t threads = 1) {
  ThreadPool pool(threads);
  auto likelihood = FieldLikelihood::make(std::move(field), config);
  EXPECT_TRUE(likelihood.has_value());
  EXPECT_TRUE(likelihood->set_observation(voxels, pool).has_value());
  return *likelihood->score(poses, pool);
}

void expect_faithful(std::shared_ptr<const DistanceField> field,
                     const reference::FieldTruth& truth,
                     const FieldModelConfig& config,
                     const reference::FieldModel& model,
                     const std::vector<Pose2>& poses) {
  const DepthObservation seen = photograph(room(), standing_place());
  const FieldScores scores = scores_of(std::move(field), config, voxels_of(seen), poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto literal = reference::literal_likelihood(seen, truth, model, poses[i]);
    EXPECT_EQ(scores.pixels, literal.pixels);
    EXPECT_NEAR(scores.mean_log_likelihood(i), literal.mean(), kFaithful) << "pose " << i;
  }
}

TEST(FieldLikelihoodTest, OnAPlanItIsThePapersPixelByPixel) {
  const map::ColumnMap plan = room();
  const reference::PlanTruth truth(plan, room_classes(), 1.0);
  expect_faithful(field_of_room(), truth, {}, {}, poses_to_score());
}

TEST(FieldLikelihoodTest, EachCueAloneIsThePapersPixelByPixel) {
  const map::ColumnMap plan = room();
  const reference::PlanTruth truth(plan, room_classes(), 1.0);
  const std::vector<Pose2> pose = {poses_to_score()[2]};
  expect_faithful(
      field_of_room(), truth, {.cue = FieldCue::kSdf}, {.z_sdf = 1.0, .z_sem = 0.0}, pose);
  expect_faithful(
      field_of_room(), truth, {.cue = FieldCue::kSem}, {.z_sdf = 0.0, .z_sem = 1.0}, pose);
}

TEST(FieldLikelihoodTest, OnAFusedVolumeItIsThePapersPixelByPixel) {
  Rng rng(8, "volume");
  const SemanticVolume volume = volume_of_room(room(), rng);
  const reference::VolumeTruth truth(volume, 0.2, 1.0);
  expect_faithful(*distances_of_volume(volume, 0.2, SurfaceReach::kTruncation),
                  truth,
                  {},
                  {},
                  {poses_to_score()[0], poses_to_score()[2]});
}

TEST(FieldLikelihoodTest, ThePlaceOfThePhotographIsTheLikeliest) {
  const VoxelList voxels = voxels_of(photograph(room(), standing_place()));
  for (const FieldCue cue : {FieldCue::kSdf, FieldCue::kSem, FieldCue::kSdfSem}) {
    const FieldScores scores = scores_of(field_of_room(), {.cue = cue}, voxels, poses_to_score());
    for (std::size_t i = 1; i < scores.losses.size(); ++i) {
      EXPECT_LT(scores.losses[0], scores.losses[i]);
    }
  }
}

/// One voxel of 5 cm over the cell at the base, one metre up.
VoxelList one_voxel(ClassId label, std::uint32_t count = 1) {
  return {room_classes(), 0.05, {{0, 0, 19, label, count}}, 0.0};
}

double mean_at(const FieldModelConfig& config, const VoxelList& voxels, const Pose2& pose) {
  return scores_of(field_of_room(), config, voxels, {pose}).mean_log_likelihood(0);
}

TEST(FieldLikelihoodTest, AClassThatTheMapDoesNotHaveIsAtFourSigma) {
  const Pose2 place = standing_place();
  const double metric = mean_at({.cue = FieldCue::kSdf}, one_voxel(1), place);
  const double expected = std::log(0.5 * std::exp(metric) + 0.5 * std::exp(-8.0));
  EXPECT_NEAR(mean_at({}, one_voxel(6), place), expected, 2e-4);  // known, and nowhere drawn
  VoxelList sofa = one_voxel(7);
  sofa.classes = ClassTable({"floor", "ceiling", "wall", "table", "shelf", "lamp", "sofa"});
  EXPECT_NEAR(mean_at({}, sofa, place), expected, 2e-4);
  EXPECT_NEAR(mean_at({.cue = FieldCue::kSem}, sofa, place), -8.0, 2e-4);
}

TEST(FieldLikelihoodTest, AClassIsTheMapsClassOfItsName) {
  VoxelList shelf = one_voxel(1);
  shelf.classes = ClassTable({"shelf"});
  EXPECT_EQ(mean_at({}, shelf, standing_place()), mean_at({}, one_voxel(5), standing_place()));
  EXPECT_NE(mean_at({}, shelf, standing_place()), mean_at({}, one_voxel(1), standing_place()));
}

TEST(FieldLikelihoodTest, APointBeyondTheFieldHasTheLikelihoodOfTheNearestCell) {
  // The room's plan is 3 × 2.4 m; the field goes 1 m farther.
  const Pose2 origin = room().origin;
  for (const FieldCue cue : {FieldCue::kSdf, FieldCue::kSem, FieldCue::kSdfSem}) {
    const double at_edge = mean_at({.cue = cue}, one_voxel(3), origin * Pose2{3.97, 1.0, 0.0});
    EXPECT_LT(at_edge, -0.05);
    for (const double far_m : {4.03, 60.0, 1e9}) {
      EXPECT_EQ(mean_at({.cue = cue}, one_voxel(3), origin * Pose2{far_m, 1.0, 0.0}), at_edge);
    }
  }
}

TEST(FieldLikelihoodTest, APixelOfUnknownClassUsesPSdfAlone) {
  const Pose2 place = standing_place();
  const double metric = mean_at({.cue = FieldCue::kSdf}, one_voxel(3), place);
  EXPECT_EQ(mean_at({}, one_voxel(kUnknown), place), metric);
}

TEST(FieldLikelihoodTest, ByClassAlonePixelsOfUnknownClassDoNotCount) {
  VoxelList voxels = one_voxel(3, 4);
  voxels.voxels.push_back({2, 0, 19, kUnknown, 3});
  const FieldModelConfig config{.cue = FieldCue::kSem};
  EXPECT_EQ(scores_of(field_of_room(), config, voxels, {standing_place()}).pixels, 4);
  ThreadPool pool(1);
  auto likelihood = FieldLikelihood::make(field_of_room(), config);
  EXPECT_FALSE(likelihood->set_observation(one_voxel(kUnknown), pool).has_value());
}

TEST(FieldLikelihoodTest, AVoxelOfManyPixelsIsThatManyPixels) {
  const auto loss = [](std::uint32_t count) {
    return scores_of(field_of_room(), {}, one_voxel(4, count), {standing_place()}).losses[0];
  };
  EXPECT_GT(loss(1), 0);
  EXPECT_EQ(loss(1'000'000), 1'000'000 * loss(1));
}

TEST(FieldLikelihoodTest, WeightsAreTemperedToTheEffectivePixels) {
  const FieldScores scores{{8000 * 50, 8000 * 100}, 100};
  EXPECT_DOUBLE_EQ(scores.mean_log_likelihood(0), -0.5);
  EXPECT_DOUBLE_EQ(scores.log_weight({.effective_pixels = 30.0}, 1), -30.0);
  EXPECT_DOUBLE_EQ(scores.log_weight({.effective_pixels = std::nullopt}, 1), -100.0);
}

TEST(FieldLikelihoodTest, ThreadsDoNotChangeAnyNumber) {
  const VoxelList voxels = voxels_of(photograph(room(), standing_place()));
  Rng rng(2, "poses");
  std::vector<Pose2> poses;
  for (int i = 0; i < 700; ++i) {
    poses.push_back(room().origin *
                    Pose2{rng.uniform(-0.5, 3.5), rng.uniform(-0.5, 2.9), rng.uniform(-3.1, 3.1)});
  }
  const FieldScores one = scores_of(field_of_room(), {}, voxels, poses, 1);
  EXPECT_EQ(one.losses.size(), 700U);
  EXPECT_EQ(scores_of(field_of_room(), {}, voxels, poses, 3).losses, one.losses);
}

TEST(FieldLikelihoodTest, AnEarlierObservationLeavesNoTrace) {
  ThreadPool pool(1);
  const std::vector<Pose2> poses = poses_to_score();
  const VoxelList voxels = voxels_of(photograph(room(), standing_place()));
  auto likelihood = FieldLikelihood::make(field_of_room(), {});
  ASSERT_TRUE(likelihood->set_observation(one_voxel(2), pool).has_value());
  ASSERT_TRUE(likelihood->set_observation(voxels, pool).has_value());
  EXPECT_EQ(likelihood->score(poses, pool)->losses,
            scores_of(field_of_room(), {}, voxels, poses).losses);
}

TEST(FieldLikelihoodTest, ObservationsPreparedSideBySideAreScoredAsIfAlone) {
  ThreadPool pool(1);
  const std::vector<Pose2> poses = poses_to_score();
  const VoxelList photographed = voxels_of(photograph(room(), standing_place()));
  // Of the few slices that are kept the second observation drops all of the first.
  const auto kept = FieldLikelihood::make(field_of_room(), {}, 4'000'000);
  const auto first = kept->prepare(photographed, pool);
  ASSERT_TRUE(first.has_value());
  for (int z = 0; z < 300; ++z) {
    const VoxelList other{room_classes(), 0.05, {{0, 0, static_cast<std::int16_t>(z), 4, 1}}, 0.0};
    ASSERT_TRUE(kept->prepare(other, pool).has_value());
  }
  EXPECT_EQ(kept->score(**first, poses, pool)->losses,
            scores_of(field_of_room(), {}, photographed, poses).losses);
}

TEST(FieldLikelihoodTest, AnObservationOfMoreSlicesThanMayBeKeptIsRefused) {
  ThreadPool pool(1);
  const auto likelihood = FieldLikelihood::make(field_of_room(), {}, 1000);
  EXPECT_EQ(likelihood->prepare(one_voxel(2), pool).error().code, ErrorCode::kResourceExhausted);
}

TEST(FieldLikelihoodTest, WithoutObservationOrWithPosesThatAreNotFiniteThereIsNoScore) {
  ThreadPool pool(1);
  auto likelihood = FieldLikelihood::make(field_of_room(), {});
  EXPECT_EQ(likelihood->score({}, pool).error().code, ErrorCode::kFailedPrecondition);
  ASSERT_TRUE(likelihood->set_observation(one_voxel(2), pool).has_value());
  EXPECT_TRUE(likelihood->score({}, pool)->losses.empty());
  const std::vector<Pose2> broken = {{0.0, std::nan(""), 0.0}};
  EXPECT_EQ(likelihood->score(broken, pool).error().code, ErrorCode::kInvalidArgument);
  VoxelList voxels = one_voxel(2);
  voxels.voxel_m = 0.0;
  EXPECT_FALSE(likelihood->set_observation(voxels, pool).has_value());
  EXPECT_FALSE(likelihood->score({}, pool).has_value());
}

}  // namespace
}  // namespace semview::field
