// SPDX-License-Identifier: Apache-2.0
// What a stored view takes, in bytes and time, and what other ways to store it would take:
// `bench_storage [MAP…]` (default: the shipped plans).
//
// Views are cast in 8 × 8-cell blocks spread over the map. Every coding is checked to give back
// what went in. The codings take turns; the least thread time of each is printed, so that on a busy
// machine the ratios hold. `bench_storage --likelihoods MAP…` prints the table of
// src/semview/view/view_situations.cpp as these maps would have it.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "semview/map/cell_grid.hpp"
#include "semview/map/column_map.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/column_renderer.hpp"
#include "semview/raycast/column_scene.hpp"
#include "semview/view/view_codec.hpp"
#include "storage_codings.hpp"
#include "storage_likelihoods.hpp"
#include "usage.hpp"

namespace semview::bench {
namespace {

constexpr std::size_t kBlocks = 24;
constexpr int kBlockCells = 8;
constexpr int kRounds = 5;

double thread_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Views in blocks of neighbouring cells.
using Blocks = std::vector<std::vector<ColumnView>>;

Blocks cast_blocks(const map::ColumnMap& plan, bool ranges) {
  const ViewProfile profile;
  const raycast::ColumnScene scene = raycast::ColumnScene::build(plan);
  const map::CellGrid grid = map::build_cell_grid(plan, profile.eye_height_m);
  std::map<std::pair<int, int>, std::vector<CellIndex>> cells;
  for (const CellIndex& cell : grid.free_cells()) {
    if (!grid.has_eye(cell)) continue;
    cells[{cell.iy >> 3, cell.ix >> 3}].push_back(cell);
  }
  std::vector<std::vector<CellIndex>> whole;
  for (auto& [place, block] : cells) {
    if (block.size() == kBlockCells * kBlockCells) whole.push_back(std::move(block));
  }
  Blocks blocks;
  const std::size_t step = std::max<std::size_t>(1, whole.size() / kBlocks);
  for (std::size_t i = 0; i < whole.size(); i += step) {
    std::vector<ColumnView>& block = blocks.emplace_back();
    for (const CellIndex& cell : whole[i]) {
      raycast::PanoramaRequest request;
      request.map_from_robot = PoseGrid::center(cell);
      request.eye_z_m = plan.ground_height_m + profile.eye_height_m;
      request.camera = profile.camera;
      block.push_back(raycast::render_column_view(scene, request, ranges));
    }
  }
  return blocks;
}

/// A way to store views: what goes into one piece, and how that piece is written and read.
struct Coding {
  std::string name;
  std::size_t cells_a_piece = 1;
  std::function<Bytes(std::span<const ColumnView>)> encode;
  /// Reads the piece; false if that is not what went in.
  std::function<bool(const Bytes&, std::span<const ColumnView>)> decode;
  double bytes = 0.0;  // a view
  double encode_s = std::numeric_limits<double>::infinity();
  double decode_s = std::numeric_limits<double>::infinity();
};

using Serialize = Bytes (*)(const ColumnView&);

Bytes joined(Serialize serialize, std::span<const ColumnView> views) {
  Bytes bytes;
  for (const ColumnView& view : views) {
    const Bytes part = serialize(view);
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

/// Decoding stops at the serialized bytes: what comes behind costs every zstd coding the same.
Coding zstd(std::string name, Serialize serialize, Zstd coder, std::size_t cells_a_piece = 1) {
  const auto shared = std::make_shared<Zstd>(std::move(coder));
  return {
      std::move(name),
      cells_a_piece,
      [=](std::span<const ColumnView> views) { return shared->compress(joined(serialize, views)); },
      [=](const Bytes& bytes, std::span<const ColumnView> views) {
        return views.empty() ? !shared->decompress(bytes).empty()
                             : shared->decompress(bytes) == joined(serialize, views);
      }};
}

Coding codec_2(bool ranges) {
  return {"codec 2",
          1,
          [](std::span<const ColumnView> views) { return encode_view(views.front()); },
          [ranges](const Bytes& bytes, std::span<const ColumnView> views) {
            const auto view = decode_view(kViewCodec, bytes, {360, 90, ranges});
            return view && (views.empty() || *view == views.front());
          }};
}

std::vector<Coding> codings(const Blocks& blocks) {
  // Dictionaries learn from every other block and are measured on all: in their favour.
  std::vector<Bytes> samples;
  for (std::size_t i = 0; i < blocks.size(); i += 2) {
    for (const ColumnView& view : blocks[i]) samples.push_back(delta_runs(view));
  }
  const Bytes dictionary = train_dictionary(samples);
  constexpr std::size_t kBlock = kBlockCells * kBlockCells;
  return {zstd("pixels, zstd 3", pixels, Zstd(3)),
          zstd("runs, zstd 3", plain_runs, Zstd(3)),
          zstd("delta runs, zstd 3", delta_runs, Zstd(3)),
          zstd("delta runs, zstd 6 (codec 1)", delta_runs, Zstd(6)),
          zstd("delta runs, zstd 3, dictionary", delta_runs, Zstd(3, dictionary)),
          zstd("delta runs, zstd 6, dictionary", delta_runs, Zstd(6, dictionary)),
          zstd("delta runs, zstd 15, dictionary", delta_runs, Zstd(15, dictionary)),
          codec_2(false),
          zstd("delta runs, zstd 3, 8x8 block", delta_runs, Zstd(3), kBlock),
          zstd("delta runs, zstd 15, 8x8 block", delta_runs, Zstd(15), kBlock)};
}

/// One round; false if something did not come back as it was.
bool measure(Coding& coding, const Blocks& blocks, bool check) {
  std::vector<std::span<const ColumnView>> pieces;
  for (const std::vector<ColumnView>& block : blocks) {
    for (std::size_t i = 0; i < block.size(); i += coding.cells_a_piece) {
      pieces.push_back(std::span(block).subspan(i, coding.cells_a_piece));
    }
  }
  const auto views = static_cast<double>(pieces.size() * coding.cells_a_piece);
  std::vector<Bytes> coded(pieces.size());
  double start_s = thread_s();
  for (std::size_t i = 0; i < pieces.size(); ++i) coded[i] = coding.encode(pieces[i]);
  coding.encode_s = std::min(coding.encode_s, (thread_s() - start_s) / views);
  start_s = thread_s();
  bool good = true;
  for (const Bytes& piece : coded) good = coding.decode(piece, {}) && good;
  // Of a piece: to read one cell, all of it is decoded.
  const auto count = static_cast<double>(pieces.size());
  coding.decode_s = std::min(coding.decode_s, (thread_s() - start_s) / count);
  if (check) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      good = coding.decode(coded[i], pieces[i]) && good;
  }
  coding.bytes = 0.0;
  for (const Bytes& piece : coded) coding.bytes += static_cast<double>(piece.size()) / views;
  return good;
}

int print_table(const std::string& name, const map::ColumnMap& plan) {
  const Blocks blocks = cast_blocks(plan, false);
  const Blocks with_ranges = cast_blocks(plan, true);
  if (blocks.empty()) return 1;
  std::vector<Coding> table = codings(blocks);
  Coding ranges = codec_2(true);
  ranges.name = "codec 2, with ranges";
  bool good = true;
  for (int round = 0; round < kRounds; ++round) {
    for (Coding& coding : table) good = measure(coding, blocks, round == 0) && good;
    good = measure(ranges, with_ranges, round == 0) && good;
  }
  table.push_back(std::move(ranges));
  fmt::print("{}: {} views of 360 x 90 in {} blocks\n", name, blocks.size() * 64, blocks.size());
  fmt::print(
      "{:<34}{:>12}{:>20}{:>22}\n", "", "bytes a view", "us to write a view", "us to read a cell");
  for (const Coding& coding : table) {
    fmt::print("{:<34}{:>12.1f}{:>20.1f}{:>22.1f}\n",
               coding.name,
               coding.bytes,
               coding.encode_s * 1e6,
               coding.decode_s * 1e6);
  }
  if (!good) fmt::print("a coding did not give back what went in\n");
  return good ? 0 : 1;
}

int run(std::vector<std::string> arguments) {
  const bool likelihoods = !arguments.empty() && arguments.front() == "--likelihoods";
  if (likelihoods) arguments.erase(arguments.begin());
  if (arguments.empty()) {
    for (const char* name :
         {"duplex_level1", "duplex_level2", "largebuilding_level1", "tutorial"}) {
      arguments.push_back(std::string(SEMVIEW_SOURCE_DIR "/maps/") + name);
    }
  }
  SymbolCounts counts{};
  int code = 0;
  for (const std::string& path : arguments) {
    const auto loaded = map::load_map(path);
    const auto* plan = loaded ? std::get_if<map::ColumnMap>(&loaded->geometry) : nullptr;
    if (plan == nullptr) {
      fmt::print(
          stderr, "{}: {}\n", path, loaded ? "not an extruded plan" : loaded.error().message);
      return 1;
    }
    if (likelihoods) {
      count_symbols(cast_blocks(*plan, false), counts);
    } else {
      code = std::max(code, print_table(loaded->id, *plan));
    }
  }
  if (likelihoods) print_likelihoods(counts);
  return code;
}

}  // namespace
}  // namespace semview::bench

int main(int argc, char** argv) {
  constexpr const char* kUsage =
      "bench_storage [--likelihoods] [MAP...]\n"
      "What stored views of maps (default: the shipped plans) take in bytes and time, and what "
      "they "
      "would\n"
      "take in other ways; --likelihoods prints the table of src/semview/view/view_situations.cpp.";
  if (const auto code = semview::bench::explain(argc, argv, kUsage, {"--likelihoods"}))
    return *code;
  return semview::bench::run({argv + 1, argv + argc});
}
