// SPDX-License-Identifier: Apache-2.0
#include "client/robot/run_outputs.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

namespace semview::robot {
namespace {

/// Text as one CSV field: reasons are sentences and may hold commas.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return '"' + text + '"';
}

/// Six fields, empty where no distortion is estimated.
std::string affine_fields(const std::optional<localization::AffineEstimate>& affine) {
  if (!affine) return ",,,,,";
  const MapAffine& mean = affine->mean;
  return fmt::format("{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f}",
                     mean.a,
                     affine->a_sigma,
                     mean.b,
                     affine->b_sigma,
                     mean.k,
                     affine->k_sigma);
}

}  // namespace

std::vector<io::StampedPose2> trajectory(std::span<const FrameReport> frames) {
  std::vector<io::StampedPose2> poses;
  poses.reserve(frames.size());
  for (const FrameReport& frame : frames) {
    poses.push_back({frame.stamp_s, frame.estimate.map_from_robot});
  }
  return poses;
}

std::string frames_csv(std::span<const FrameReport> frames) {
  std::string text =
      "stamp_s,state,x_m,y_m,yaw_deg,sigma_major_m,sigma_minor_m,sigma_major_yaw_deg,"
      "sigma_yaw_deg,mode_weight,n_eff,resampled,best_similarity,mean_similarity,without_view,"
      "cells_memory,cells_disk,cells_cast,particles,replaced,lost_probability,scale_x,"
      "scale_x_sigma,scale_y,scale_y_sigma,shear,shear_sigma,reason\n";
  for (const FrameReport& frame : frames) {
    const Pose2& pose = frame.estimate.map_from_robot;
    const localization::Ellipse ellipse = localization::position_ellipse(frame.estimate);
    fmt::format_to(std::back_inserter(text),
                   "{:.9f},{},{:.6f},{:.6f},{:.4f},{:.4f},{:.4f},{:.2f},{:.3f},{:.4f},{:.2f},{},"
                   "{:.6f},{:.6f},{},{},{},{},{},{},{},{},{}\n",
                   frame.stamp_s,
                   name(frame.state),
                   pose.x_m,
                   pose.y_m,
                   deg_from_rad(pose.yaw_rad),
                   ellipse.major_sigma_m,
                   ellipse.minor_sigma_m,
                   deg_from_rad(ellipse.major_yaw_rad),
                   deg_from_rad(frame.estimate.heading_sigma_rad),
                   frame.estimate.weight,
                   frame.effective_sample_size,
                   frame.resampled ? 1 : 0,
                   frame.scores.best_similarity,
                   frame.scores.mean_similarity,
                   frame.scores.without_view,
                   frame.scores.origins.memory,
                   frame.scores.origins.disk,
                   frame.scores.origins.cast,
                   frame.particles,
                   frame.replaced,
                   frame.lost_probability ? fmt::format("{:.4f}", *frame.lost_probability) : "",
                   affine_fields(frame.affine),
                   quoted(frame.reason));
  }
  return text;
}

std::string particles_csv(const localization::ParticleSet& particles) {
  std::string text = "x_m,y_m,yaw_deg,weight\n";
  for (const localization::Particle& particle : particles) {
    fmt::format_to(std::back_inserter(text),
                   "{:.6f},{:.6f},{:.4f},{:.9f}\n",
                   particle.map_from_robot.x_m,
                   particle.map_from_robot.y_m,
                   deg_from_rad(particle.heading_rad),
                   particle.weight);
  }
  return text;
}

}  // namespace semview::robot
