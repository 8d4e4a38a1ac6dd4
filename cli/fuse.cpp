// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "duration_text.hpp"
#include "fuse_check.hpp"
#include "fuse_frames.hpp"
#include "semview/field/vdb_file.hpp"
#include "semview/io/output_path.hpp"
#include "stop_signals.hpp"
#include "verb.hpp"
#include "volume_bundle.hpp"

namespace semview::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::filesystem::path log;
  std::filesystem::path output;
  FrameOptions frames;
  field::VolumeShape shape;
  field::FusionConfig fusion;
  std::size_t every = 1;
  std::size_t check_every = 0;  ///< of these every Nth is left out and compared; 0: none
  std::size_t min_frames = 2;   ///< that must have seen a surface
};

enum class Use { kNone, kFuse, kCompare };

Use use_of(std::size_t frame, const Options& options) {
  if (frame % options.every != 0) return Use::kNone;
  const std::size_t taken = frame / options.every;
  const std::size_t n = options.check_every;
  return n > 0 && taken % n == n / 2 ? Use::kCompare : Use::kFuse;
}

/// What the result depends on: a fusion goes on only where all of it agrees.
std::string source_of(const Options& options, const FuseFrames& frames) {
  return fmt::format(
      "log {} ({}), every {} but every {}, labels '{}', segment '{}', depth {} to {} m",
      std::filesystem::weakly_canonical(options.log).filename().string(),
      to_hex(frames.fingerprint()),
      options.every,
      options.check_every,
      options.frames.labels.filename().string(),
      options.frames.segment,
      options.fusion.min_depth_m,
      options.fusion.max_depth_m);
}

Result<field::StoredVolume> open_volume(const std::filesystem::path& file,
                                        const Options& options,
                                        const FuseFrames& frames) {
  const std::string source = source_of(options, frames);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return field::StoredVolume{{options.shape, frames.classes()}, 0, 0, source};
  }
  SEMVIEW_TRY(field::StoredVolume stored, field::read_vdb(file));
  const bool same = stored.source == source && stored.volume.shape() == options.shape &&
                    stored.volume.classes() == frames.classes();
  if (same) return stored;
  return fail(Error{ErrorCode::kAlreadyExists,
                    fmt::format("{}: holds another fusion ({})", file.string(), stored.source),
                    {},
                    "remove it, or name another output: -o"});
}

/// One line that is written over on a terminal, a line every two seconds otherwise.
class Progress {
 public:
  Progress(std::size_t first, std::size_t total) : first_(first), total_(total) {}

  void show(std::size_t done) {
    const auto now = Clock::now();
    if (done < total_ && (done == first_ || now < next_)) return;
    next_ = now + (on_terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(2000));
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double a_frame_s =
        elapsed_s / static_cast<double>(std::max<std::size_t>(done - first_, 1));
    fmt::print("{}{} of {} frames, {} left{}",
               on_terminal_ ? "\r" : "",
               done,
               total_,
               duration_text(a_frame_s * static_cast<double>(total_ - done)),
               on_terminal_ ? "   " : "\n");
    std::fflush(stdout);
  }
  void finish() const {
    if (on_terminal_) fmt::print("\n");
  }

 private:
  bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  std::size_t first_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

/// Fuses what is left, as far as no one asks to stop.
Status fuse_frames(const FuseFrames& frames,
                   const Options& options,
                   const std::filesystem::path& file,
                   field::StoredVolume& stored) {
  constexpr auto kBetweenSaves = std::chrono::seconds(30);
  ThreadPool pool;
  Progress progress(stored.frames, frames.size());
  auto saved = Clock::now();
  for (; stored.frames < frames.size() && !stop_asked(); ++stored.frames) {
    progress.show(stored.frames);
    if (use_of(stored.frames, options) != Use::kFuse) continue;
    const Result<field::DepthFrame> frame = frames.read(stored.frames);
    const Result<field::FusedFrame> fused =
        frame ? field::fuse(*frame, options.fusion, pool, stored.volume) : fail(frame.error());
    if (!fused && fused.error().code == ErrorCode::kResourceExhausted) return fail(fused.error());
    if (!fused) {
      ++stored.skipped;
      fmt::print(stderr, "semview: frame {} skipped: {}\n", stored.frames, fused.error().message);
    }
    if (Clock::now() - saved > kBetweenSaves) {
      // This frame is in: a fusion that goes on from here begins after it.
      ++stored.frames;
      const Status written = field::write_vdb(file, stored);
      --stored.frames;
      SEMVIEW_TRY_STATUS(written);
      saved = Clock::now();
    }
  }
  progress.show(stored.frames);
  progress.finish();
  return field::write_vdb(file, stored);
}

/// Says how well the map predicts the frames that were left out of it.
Status compare_left_out(const FuseFrames& frames,
                        const Options& options,
                        const map::TriangleMesh& mesh) {
  std::vector<std::size_t> left_out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (use_of(i, options) == Use::kCompare) left_out.push_back(i);
  }
  SEMVIEW_TRY(const LeftOutFindings findings,
              check_left_out(frames, left_out, mesh, options.fusion.max_depth_m));
  fmt::print(
      "left out {} frame{}: median depth error {:.1f} mm, a surface for {:.1f} % of the pixels\n",
      findings.frames,
      findings.frames == 1 ? "" : "s",
      1000.0 * findings.residuals.median_m(),
      100.0 * findings.residuals.covered());
  return {};
}

/// What is written, and where.
struct Output {
  std::filesystem::path folder;
  std::filesystem::path volume;
};

Output output_of(const std::filesystem::path& output) {
  if (output.extension() != ".vdb") return {output, output / "volume.vdb"};
  return {output.has_parent_path() ? output.parent_path() : ".", output};
}

/// The program's exit code.
Result<int> run(const Options& options) {
  SEMVIEW_TRY_STATUS(field::validate(options.shape));
  SEMVIEW_TRY_STATUS(field::validate(options.fusion));
  const Output output = output_of(options.output);
  SEMVIEW_TRY_STATUS(io::check_output_folder(output.folder));
  SEMVIEW_TRY_STATUS(check_volume_bundle(output.folder, output.volume.filename()));
  SEMVIEW_TRY(io::RunLog log, io::read_run_log(options.log));
  SEMVIEW_TRY(const FuseFrames frames, FuseFrames::open(std::move(log), options.frames));
  std::error_code made;
  std::filesystem::create_directories(output.folder, made);
  if (made) return io::cannot_write(output.folder, made.value());
  SEMVIEW_TRY(field::StoredVolume stored, open_volume(output.volume, options, frames));
  ask_to_stop_on_signals();
  if (stored.frames > 0) {
    fmt::print("{}: goes on after {} frames\n", output.volume.string(), stored.frames);
  }
  SEMVIEW_TRY_STATUS(fuse_frames(frames, options, output.volume, stored));
  if (stored.frames < frames.size()) {
    fmt::print(stderr,
               "semview: stopped after {} of {} frames\n  run the same command again to go on\n",
               stored.frames,
               frames.size());
    return kExitFailed;
  }
  field::VolumeMeshConfig surface;
  surface.min_weight = static_cast<float>(options.min_frames);
  SEMVIEW_TRY(const BundleFindings bundle,
              write_volume_bundle(output.folder, output.volume.filename(), stored.volume, surface));
  fmt::print("{}: {} triangles, floor at {:.3f} m; {} of {} frame{} skipped\n",
             output.folder.string(),
             bundle.mesh.triangles.size(),
             bundle.ground_height_m,
             stored.skipped,
             frames.size(),
             frames.size() == 1 ? "" : "s");
  if (options.check_every > 0) {
    SEMVIEW_TRY_STATUS(compare_left_out(frames, options, bundle.mesh));
  }
  return 0;
}

}  // namespace

void add_fuse_verb(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("fuse", "Make a semantic volume of a log with depth images");
  verb->description(
      "Fuses the depth images, labels and colours of a run log into a truncated signed distance\n"
      "field, an OpenVDB file, and writes its surface beside it as a mesh map. Frames that cannot\n"
      "be used are skipped with a line each. Ctrl-C stops cleanly; the same command goes on.");
  verb->add_option("LOG", options->log, "Run log with depth/ and poses.txt")->required();
  verb->add_option("-o,--out", options->output, "Folder of the map, or its volume's .vdb file")
      ->required();
  verb->add_option("--voxel", options->shape.voxel_m, "Edge of a voxel, m")->capture_default_str();
  verb->add_option("--truncation", options->shape.truncation_m, "Distances are kept up to here, m")
      ->capture_default_str();
  verb->add_option("--max-depth", options->fusion.max_depth_m, "Farther is not fused, m")
      ->capture_default_str();
  verb->add_option(
      "--poses", options->frames.poses, "TUM file, map_from_camera; default: the log's");
  verb->add_option("--labels",
                   options->frames.labels,
                   "Folder of label images, or lists of instance masks, named as the depths");
  verb->add_option("--segment", options->frames.segment, "Network that labels the images");
  verb->add_option("--every", options->every, "Take every Nth frame")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--check-every",
                   options->check_every,
                   "Leave every Nth of these out and say how well the map predicts its depths");
  verb->add_option("--min-frames", options->min_frames, "A surface was seen by so many frames")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option(
          "--up", options->frames.up, "What points up in the poses' frame: z, -y, or x,y,z")
      ->capture_default_str();
  verb->footer("Example:\n  semview fuse room_log -o room --segment deeplab_ade20k32");
  verb->callback([options, &exit_code] {
    const Result<int> code = run(*options);
    exit_code = code ? *code : report(fail(code.error()));
  });
}

}  // namespace semview::cli
