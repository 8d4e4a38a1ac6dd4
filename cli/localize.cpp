// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "client/robot/run_log_player.hpp"
#include "client/robot/run_outputs.hpp"
#include "duration_text.hpp"
#include "localize_options.hpp"
#include "localize_scorer.hpp"
#include "localize_start.hpp"
#include "localize_summary.hpp"
#include "log_depths.hpp"
#include "log_images.hpp"
#include "semview/core/log.hpp"
#include "semview/io/output_path.hpp"
#include "semview/io/run_log.hpp"
#include "semview/io/text_file.hpp"
#include "stop_signals.hpp"
#include "verb.hpp"

namespace semview::cli {
namespace {

/// Tells a person how it goes: a line that renews itself on a terminal, else only the stretches
/// that nobody could score.
class Progress {
 public:
  static bool on_terminal() { return ::isatty(STDERR_FILENO) == 1; }

  void show(const robot::FrameReport& report, std::size_t done, std::size_t total) {
    const bool stale = report.state == robot::FrameState::kStale;
    if (on_terminal()) {
      const Pose2& pose = report.estimate.map_from_robot;
      fmt::print(stderr,
                 "\r\x1b[Kframe {}/{}  {:.2f} {:.2f} m  {:.0f} deg  sigma {:.2f} m  N_eff {:.0f}  "
                 "similarity {:.3f}  lost {:.2f}  {}{}",
                 done,
                 total,
                 pose.x_m,
                 pose.y_m,
                 deg_from_rad(pose.yaw_rad),
                 localization::position_ellipse(report.estimate).major_sigma_m,
                 report.effective_sample_size,
                 report.scores.best_similarity,
                 report.lost_probability.value_or(0.0),
                 name(report.state),
                 done == total ? "\n" : "");
      std::fflush(stderr);
    } else if (stale != stale_) {
      if (stale) {
        log_warning(fmt::format("frame {}: going on by odometry: {}", done, report.reason));
      } else {
        log_info(fmt::format("frame {}: scored again", done));
      }
    }
    stale_ = stale;
  }

 private:
  bool stale_ = false;
};

/// Tells a person how far the search of a dense start is: its views may all have to be cast.
class SearchLine {
 public:
  /// False once somebody asks to stop.
  bool show(std::size_t done, std::size_t cells) {
    using Seconds = std::chrono::duration<double>;
    const auto now = std::chrono::steady_clock::now();
    const double elapsed_s = Seconds(now - start_).count();
    const double left_s = elapsed_s * static_cast<double>(cells - done) / static_cast<double>(done);
    const std::string text =
        fmt::format("searching: {} of {} cells, {} left", done, cells, duration_text(left_s));
    if (Progress::on_terminal()) {
      fmt::print(stderr, "\r\x1b[K{}", text);
      std::fflush(stderr);
    } else if (done < cells && now - told_ >= kBetweenLines) {
      log_info(text);
      told_ = now;
    }
    return !stop_asked();
  }

 private:
  static constexpr std::chrono::seconds kBetweenLines{5};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point told_ = start_;
};

/// Holds a log back to `rate` times its recorded speed.
std::function<void(double)> pacer(double rate) {
  if (rate <= 0.0) return {};
  std::optional<std::pair<double, std::chrono::steady_clock::time_point>> first;
  return [rate, first](double stamp_s) mutable {
    if (!first) first.emplace(stamp_s, std::chrono::steady_clock::now());
    const std::chrono::duration<double> after((stamp_s - first->first) / rate);
    const auto due =
        first->second + std::chrono::duration_cast<std::chrono::steady_clock::duration>(after);
    while (!stop_asked() && std::chrono::steady_clock::now() < due) {
      std::this_thread::sleep_until(
          std::min(due, std::chrono::steady_clock::now() + std::chrono::milliseconds(50)));
    }
  };
}

Status write_outputs(const LocalizeOptions& options,
                     const robot::Drive& drive,
                     const localization::ParticleSet& particles) {
  const std::filesystem::path track(options.output);
  SEMVIEW_TRY_STATUS(io::write_tum(track, robot::trajectory(drive.frames)));
  std::filesystem::path beside = track;
  SEMVIEW_TRY_STATUS(io::write_text_file(beside.replace_extension(".frames.csv"),
                                         robot::frames_csv(drive.frames)));
  beside = track;
  return io::write_text_file(beside.replace_extension(".particles.csv"),
                             robot::particles_csv(particles));
}

/// A run that ends early leaves the estimates up to there.
Status end_early(const LocalizeOptions& options,
                 const robot::Drive& so_far,
                 const localization::ParticleSet& particles,
                 Error error) {
  if (so_far.frames.empty()) return fail(std::move(error));
  if (Progress::on_terminal()) fmt::print(stderr, "\n");
  const Status written = write_outputs(options, so_far, particles);
  const std::string kept = written
                               ? fmt::format("{}: has the estimates of the {} frame{} before it",
                                             options.output,
                                             so_far.frames.size(),
                                             so_far.frames.size() == 1 ? "" : "s")
                               : written.error().message;
  error.hint += error.hint.empty() ? kept : "; " + kept;
  return fail(std::move(error));
}

Status localize(const CLI::App& verb, const LocalizeOptions& options) {
  SEMVIEW_TRY_STATUS(check_localize_options(verb, options));
  SEMVIEW_TRY(const robot::LocalizerConfig config, localizer_config(options));
  SEMVIEW_TRY(const auto motion, motion_model(options));
  SEMVIEW_TRY_STATUS(io::check_output_file(options.output));
  SEMVIEW_TRY(const io::RunLog log, io::read_run_log(options.log));
  SEMVIEW_TRY(const std::optional<LogDepths> depths, open_log_depths(log, options.model));
  SEMVIEW_TRY(const auto images,
              depths ? Result<std::optional<LogImages>>(std::nullopt)
                     : open_log_images(log, options.segment));
  SEMVIEW_TRY(const Scorer scorer,
              open_scorer(options, images ? images->classes() : log.setup.classes));
  SEMVIEW_TRY(localization::ParticleSet start, first_particles(options, scorer.free_cells));

  ask_to_stop_on_signals();
  if (!Progress::on_terminal()) {
    log_info(fmt::format("localizing {} frames; engine {} ({}); weights: {}",
                         log.frames.size(),
                         scorer.engine,
                         scorer.engine_reason,
                         scorer.weights));
  }
  robot::Localizer localizer(config, *scorer.source, motion, std::move(start), options.seed);
  localizer.know_free_cells(scorer.free_cells);
  SearchLine search;
  if (is_dense(options)) {
    localizer.search(scorer.free_cells, [&search](std::size_t done, std::size_t cells) {
      return search.show(done, cells);
    });
  }
  Progress progress;
  robot::Drive so_far;
  robot::PlayerHooks hooks;
  hooks.wait_until = pacer(options.rate);
  hooks.on_frame = [&](const robot::FrameReport& report, std::size_t done, std::size_t total) {
    progress.show(report, done, total);
    so_far.frames.push_back(report);
  };
  hooks.stopped = stop_asked;
  if (images) {
    hooks.observe = [&](std::size_t frame) {
      return images->observe(frame, scorer.source->profile().camera);
    };
  }
  if (depths) {
    hooks.observe = [&](std::size_t frame) {
      return depths->observe(frame, scorer.source->profile().camera);
    };
  }
  Result<robot::Drive> drive = robot::play(log, scorer.source->profile().camera, localizer, hooks);
  if (!drive) {
    return end_early(options, so_far, localizer.particles(), std::move(drive).error());
  }
  SEMVIEW_TRY_STATUS(write_outputs(options, *drive, localizer.particles()));
  print_localize_summary(options, scorer, localizer.dense_start(), *drive);
  if (scorer.site) log_unusable_records(*scorer.site, options.site.cache_directory);
  return {};
}

}  // namespace

void add_localize_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "localize",
      "Localize a robot in a map: Monte Carlo localization over a recorded drive, in this process "
      "or with a server. Writes the pose of every frame as TUM text, and beside it "
      "NAME.frames.csv (how each frame went) and NAME.particles.csv (the last particles).");
  verb->footer(
      "Example:\n"
      "  semview localize --log drive --map maps/duplex_level1 --init 2,-6,90,0.3 -o est.tum\n"
      "  semview localize --log drive --server tcp://127.0.0.1:5560 --map duplex_level1 --global "
      "-o est.tum\n"
      "  semview localize --log rgbd_drive --map maps/duplex_level1 --model sdf_sem --global "
      "-o est.tum");
  const auto options = std::make_shared<LocalizeOptions>();
  add_localize_options(*verb, *options);
  verb->callback([verb, options, &exit_code] { exit_code = report(localize(*verb, *options)); });
}

}  // namespace semview::cli
