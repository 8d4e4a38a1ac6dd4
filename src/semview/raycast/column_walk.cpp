// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_walk.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/raycast/column_walk.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

#ifndef SEMVIEW_COLUMN_WALK_SHARED
#define SEMVIEW_COLUMN_WALK_SHARED
namespace semview::raycast {

// A ray along an axis never leaves a cell across the other; the distance stays finite.
constexpr float kLeastSlope = 1e-30F;
// Added to a number below 2^22, it leaves that, rounded to a whole one, in the lowest bits.
constexpr float kRounding = 12582912.0F;
constexpr std::uint32_t kProfileBits = 0xFF00;
// Of steps, whose changes of profile one word a lane remembers.
constexpr std::size_t kBlock = 32;

/// What the lanes of a packet met in each of their steps. Keeps its memory.
struct WalkLog {
  std::vector<float> distances_m;     // step by step, lane by lane
  std::vector<std::int32_t> cells;    // the same; the high halves are not said
  std::vector<std::int32_t> changes;  // block by block, lane by lane: in which steps it changed

  void make_room(std::size_t blocks, std::size_t lanes) {
    if (changes.size() >= blocks * lanes) return;
    distances_m.resize(2 * blocks * kBlock * lanes);
    cells.resize(2 * blocks * kBlock * lanes);
    changes.resize(2 * blocks * lanes);
  }

  void append_crossings(std::size_t blocks,
                        std::size_t lane,
                        std::size_t lanes,
                        std::vector<Crossing>& crossings) const {
    for (std::size_t block = 0; block < blocks; ++block) {
      auto bits = static_cast<std::uint32_t>(changes[block * lanes + lane]);
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t step = block * kBlock + static_cast<std::size_t>(std::countr_zero(bits));
        const std::size_t at = step * lanes + lane;
        const auto profile = (static_cast<std::uint32_t>(cells[at]) & kProfileBits) >> 8;
        crossings.push_back({distances_m[at], profile});
      }
    }
  }
};

using WalkLogs = std::array<WalkLog, 2>;

}  // namespace semview::raycast
#endif

HWY_BEFORE_NAMESPACE();
namespace semview::raycast::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Ints = hn::ScalableTag<std::int32_t>;
using Float = hn::Vec<Floats>;
using Int = hn::Vec<Ints>;

/// The cells at some offsets in bytes, in the low halves.
HWY_INLINE Int cells_at(const std::uint16_t* HWY_RESTRICT cells, Int offset) {
  const Ints ints;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  // Hardware gathers 32 bits, from any address.
  return hn::GatherOffset(ints, reinterpret_cast<const std::int32_t*>(cells), offset);
#else
  HWY_ALIGN std::int32_t at[hn::MaxLanes(ints)];
  hn::Store(offset, ints, at);
  for (std::size_t i = 0; i < hn::Lanes(ints); ++i) at[i] = cells[at[i] / 2];
  return hn::Load(ints, at);
#endif
}

/// One axis of a packet.
struct Axis {
  Float slope;    // without its sign
  Float inverse;  // of that
  Float behind;
  Float behind_less_half;
  Int backwards;  // all bits where the ray falls
  Int cell;

  HWY_INLINE Axis(const EyeOnAxis& eye, const float* slopes, const std::int32_t* begins) {
    const Floats floats;
    const Float signed_slope = hn::LoadU(floats, slopes);
    const auto falls = hn::Lt(signed_slope, hn::Zero(floats));
    slope = hn::Abs(signed_slope);
    inverse = hn::Div(hn::Set(floats, 1.0F), hn::Max(slope, hn::Set(floats, kLeastSlope)));
    behind = hn::IfThenElse(falls, hn::Set(floats, eye.behind[1]), hn::Set(floats, eye.behind[0]));
    behind_less_half = hn::Sub(behind, hn::Set(floats, 0.5F));
    backwards = hn::BitCast(Ints(), hn::VecFromMask(floats, falls));
    cell = hn::LoadU(Ints(), begins);
  }

  HWY_INLINE Int pick(std::int32_t rising, std::int32_t falling) const {
    const Ints ints;
    return hn::IfVecThenElse(backwards, hn::Set(ints, falling), hn::Set(ints, rising));
  }
  /// -1 - cell where the ray falls.
  HWY_INLINE Int signed_cell() const { return hn::Xor(cell, backwards); }
  /// Where the ray leaves the cells before `end`.
  HWY_INLINE Float leaves(Int end) const {
    return hn::Mul(hn::Sub(hn::ConvertTo(Floats(), end), behind), inverse);
  }
};

/// As many rays as the target has lanes.
template <bool kThroughClosed>
struct Packet {
  Axis u;
  Axis v;
  Int first;   // offset in bytes of the eye's cell
  Int stride;  // bytes a row
  Float distance;
  Int cell = hn::Zero(Ints());
  Int changes = hn::Set(Ints(), 1);  // the first step always counts

  HWY_INLINE Packet(const ColumnGrid& grid, const ColumnRays& rays, std::size_t ray)
      : u(rays.u, &rays.slope_u[ray], &rays.begin_u[ray]),
        v(rays.v, &rays.slope_v[ray], &rays.begin_v[ray]),
        stride(hn::Set(Ints(), 2 * grid.stride())),
        distance(hn::LoadU(Floats(), &rays.begins_at_m[ray])) {
    // One more where the axis is counted backwards, as signed_cell() is one less.
    const Int eye_u = u.pick(rays.u.cell[0] + 1, rays.u.cell[1] + 2);
    const Int eye_v = v.pick(rays.v.cell[0] + 1, rays.v.cell[1] + 2);
    const Int planes = hn::Add(u.pick(0, ColumnGrid::plane(true, false)),
                               v.pick(0, ColumnGrid::plane(false, true)));
    const Int plane = hn::Mul(planes, hn::Set(Ints(), 2 * grid.plane_size()));
    first = hn::Add(plane, hn::Add(hn::Add(eye_u, eye_u), hn::Mul(eye_v, stride)));
  }

  /// Notes where the rays are and goes on; true when all have come to their ends.
  HWY_INLINE bool step(const std::uint16_t* HWY_RESTRICT cells,
                       Int bit,
                       float* HWY_RESTRICT distances_m,
                       std::int32_t* HWY_RESTRICT noted_cells) {
    const Ints ints;
    const Floats floats;
    const Int signed_u = u.signed_cell();
    const Int here = cells_at(
        cells,
        hn::Add(hn::Add(first, hn::Add(signed_u, signed_u)), hn::Mul(v.signed_cell(), stride)));
    hn::StoreU(distance, floats, distances_m);
    hn::StoreU(here, ints, noted_cells);
    const Int profile_bits = hn::Set(ints, kProfileBits);
    const auto changed = hn::Ne(hn::And(hn::Xor(here, cell), profile_bits), hn::Zero(ints));
    changes = hn::Or(changes, hn::IfThenElseZero(changed, bit));
    cell = here;
    Int reach = hn::And(here, hn::Set(ints, ColumnGrid::kReachMask));
    if constexpr (kThroughClosed) {
      const auto closed_or_not = hn::Ne(hn::And(here, profile_bits), hn::Zero(ints));
      reach = hn::Max(reach, hn::IfThenElseZero(closed_or_not, hn::Set(ints, 1)));
    }

    // A reach of 0 holds a ray where it is.
    const Int end_u = hn::Add(u.cell, reach);
    const Int end_v = hn::Add(v.cell, reach);
    const Float leaves_u = u.leaves(end_u);
    const Float leaves_v = v.leaves(end_v);
    distance = hn::Min(leaves_u, leaves_v);
    const auto across = hn::Le(leaves_u, leaves_v);
    const auto across_int = hn::RebindMask(ints, across);
    // Along the other axis: to where the ray is then, within the square.
    const Float slope = hn::IfThenElse(across, v.slope, u.slope);
    const Float behind = hn::IfThenElse(across, v.behind_less_half, u.behind_less_half);
    const Float there = hn::Add(hn::Mul(distance, slope), behind);
    const Int rounded = hn::Sub(hn::BitCast(ints, hn::Add(there, hn::Set(floats, kRounding))),
                                hn::BitCast(ints, hn::Set(floats, kRounding)));
    const Int last = hn::Sub(hn::IfThenElse(across_int, end_v, end_u), hn::Set(ints, 1));
    const Int other = hn::Max(hn::Min(rounded, last), hn::IfThenElse(across_int, v.cell, u.cell));
    u.cell = hn::IfThenElse(across_int, end_u, other);
    v.cell = hn::IfThenElse(across_int, other, end_v);
    return hn::AllTrue(ints, hn::Eq(reach, hn::Zero(ints)));
  }
};

/// Walks packet after packet.
template <bool kThroughClosed>
class Walker {
 public:
  static constexpr std::size_t kLanes = hn::MaxLanes(Ints());

  Walker(const ColumnGrid& grid, const ColumnRays& rays, std::size_t ray, WalkLog& log)
      : grid_(grid), rays_(rays), log_(log), packet_(grid, rays, ray), ray_(ray) {
    log.make_room(1, kLanes);
  }

  /// True when the packet has ended.
  HWY_INLINE bool step() {
    const std::size_t at = steps_ * kLanes;
    const bool ended =
        packet_.step(grid_.cells.data(), bit_, &log_.distances_m[at], &log_.cells[at]);
    ++steps_;
    bit_ = hn::Add(bit_, bit_);
    return ended;
  }

  /// How many steps may be taken before `close_block`.
  HWY_INLINE std::size_t left_in_block() const { return kBlock - steps_ % kBlock; }

  /// Due after every `kBlock` steps, and at the end.
  void close_block() {
    const std::size_t block = (steps_ - 1) / kBlock;
    hn::StoreU(packet_.changes, Ints(), &log_.changes[block * kLanes]);
    packet_.changes = hn::Zero(Ints());
    bit_ = hn::Set(Ints(), 1);
    log_.make_room(block + 2, kLanes);
  }

  /// The packet has ended.
  void write(Crossings& crossings) {
    close_block();
    const std::size_t blocks = (steps_ - 1) / kBlock + 1;
    for (std::size_t lane = 0; lane < kLanes && ray_ + lane < rays_.count; ++lane) {
      crossings.begin[ray_ + lane] = static_cast<std::uint32_t>(crossings.all.size());
      if (rays_.begins_at_m[ray_ + lane] > 0.0F) crossings.all.push_back({});
      log_.append_crossings(blocks, lane, kLanes, crossings.all);
      crossings.end[ray_ + lane] = static_cast<std::uint32_t>(crossings.all.size());
    }
  }

  void take(std::size_t ray) {
    packet_ = Packet<kThroughClosed>(grid_, rays_, ray);
    ray_ = ray;
    steps_ = 0;
  }

  void walk_alone(Crossings& crossings) {
    while (!step()) {
      if (left_in_block() == kBlock) close_block();
    }
    write(crossings);
  }

 private:
  const ColumnGrid& grid_;
  const ColumnRays& rays_;
  WalkLog& log_;
  Packet<kThroughClosed> packet_;
  std::size_t ray_;
  std::size_t steps_ = 0;
  Int bit_ = hn::Set(Ints(), 1);
};

/// Two packets in turn, so that one computes while the other waits for its cells.
template <bool kThroughClosed>
void walk_all(const ColumnGrid& grid,
              const ColumnRays& rays,
              WalkLogs& logs,
              Crossings& crossings) {
  using Packets = Walker<kThroughClosed>;
  static_assert(2 * Packets::kLanes <= ColumnRays::kPadding);
  Packets walkers[] = {{grid, rays, 0, logs[0]}, {grid, rays, Packets::kLanes, logs[1]}};
  std::size_t next = 2 * Packets::kLanes;
  bool walking[] = {true, rays.count > Packets::kLanes};
  while (walking[0] && walking[1]) {
    bool ended[] = {false, false};
    std::size_t left = std::min(walkers[0].left_in_block(), walkers[1].left_in_block());
    for (; left != 0 && !ended[0] && !ended[1]; --left) {
      ended[0] = walkers[0].step();
      ended[1] = walkers[1].step();
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (ended[i]) {
        walkers[i].write(crossings);
        walking[i] = next < rays.count;
        if (walking[i]) walkers[i].take(next);
        next += Packets::kLanes;
      } else if (walkers[i].left_in_block() == kBlock) {
        walkers[i].close_block();
      }
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (walking[i]) walkers[i].walk_alone(crossings);
  }
}

void walk(const ColumnGrid& grid, const ColumnRays& rays, WalkLogs& logs, Crossings& crossings) {
  if (rays.through_closed) {
    walk_all<true>(grid, rays, logs, crossings);
  } else {
    walk_all<false>(grid, rays, logs, crossings);
  }
}

}  // namespace
}  // namespace semview::raycast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace semview::raycast {
namespace {

HWY_EXPORT(walk);

/// One axis of one ray.
struct RayAxis {
  float slope;
  float inverse;
  float behind;
  bool falls;
  std::int32_t eye_cell;
  std::int32_t cell;

  RayAxis(const EyeOnAxis& eye, float signed_slope, std::int32_t begin)
      : slope(std::abs(signed_slope)),
        inverse(1.0F / std::max(slope, kLeastSlope)),
        falls(signed_slope < 0.0F),
        cell(begin) {
    behind = eye.behind[falls ? 1 : 0];
    eye_cell = eye.cell[falls ? 1 : 0];
  }

  /// Counted with the border.
  std::int64_t place() const { return eye_cell + 1 + (falls ? -cell : cell); }
  float leaves(std::int32_t end) const { return (static_cast<float>(end) - behind) * inverse; }
  std::int32_t at(float distance_m, std::int32_t end) const {
    const float there = distance_m * slope + (behind - 0.5F);
    const auto rounded =
        std::bit_cast<std::int32_t>(there + kRounding) - std::bit_cast<std::int32_t>(kRounding);
    return std::max(std::min(rounded, end - 1), cell);
  }
};

void walk_ray(const ColumnGrid& grid,
              const ColumnRays& rays,
              std::size_t ray,
              std::vector<Crossing>& crossings) {
  RayAxis u(rays.u, rays.slope_u[ray], rays.begin_u[ray]);
  RayAxis v(rays.v, rays.slope_v[ray], rays.begin_v[ray]);
  const std::uint16_t* plane =
      grid.cells.data() + std::ptrdiff_t{ColumnGrid::plane(u.falls, v.falls)} * grid.plane_size();
  float distance_m = rays.begins_at_m[ray];
  if (distance_m > 0.0F) crossings.push_back({});
  for (std::uint32_t profile = ~0U;;) {
    const std::uint32_t cell = plane[v.place() * grid.stride() + u.place()];
    const std::uint32_t here = (cell & kProfileBits) >> 8;
    if (here != profile) crossings.push_back({distance_m, here});
    profile = here;
    auto reach = static_cast<std::int32_t>(cell & ColumnGrid::kReachMask);
    if (rays.through_closed && here != 0) reach = std::max(reach, 1);
    if (reach == 0) return;
    const std::int32_t end_u = u.cell + reach;
    const std::int32_t end_v = v.cell + reach;
    const float leaves_u = u.leaves(end_u);
    const float leaves_v = v.leaves(end_v);
    distance_m = std::min(leaves_u, leaves_v);
    if (leaves_u <= leaves_v) {
      u.cell = end_u;
      v.cell = v.at(distance_m, end_v);
    } else {
      u.cell = u.at(distance_m, end_u);
      v.cell = end_v;
    }
  }
}

void clear(const ColumnRays& rays, Crossings& crossings) {
  crossings.begin.resize(rays.count);
  crossings.end.resize(rays.count);
  crossings.all.clear();
  crossings.ends_closed = !rays.through_closed;
}

}  // namespace

void walk_columns(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  // The memory of a thread is kept from view to view.
  static thread_local WalkLogs logs;
  clear(rays, crossings);
  HWY_DYNAMIC_DISPATCH(walk)(grid, rays, logs, crossings);
}

void walk_columns_singly(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  clear(rays, crossings);
  for (std::size_t ray = 0; ray < rays.count; ++ray) {
    crossings.begin[ray] = static_cast<std::uint32_t>(crossings.all.size());
    walk_ray(grid, rays, ray, crossings.all);
    crossings.end[ray] = static_cast<std::uint32_t>(crossings.all.size());
  }
}

}  // namespace semview::raycast
#endif  // HWY_ONCE
