// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_walk.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/raycast/column_walk.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

#include "semview/raycast/walk_log.hpp"

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

}  // namespace

void walk_columns(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  // The memory of a thread is kept from view to view.
  static thread_local WalkLogs logs;
  crossings.clear(rays);
  HWY_DYNAMIC_DISPATCH(walk)(grid, rays, logs, crossings);
}

}  // namespace semview::raycast
#endif  // HWY_ONCE
