// SPDX-License-Identifier: Apache-2.0
#include "semview/raycast/column_walk.hpp"

#include <algorithm>
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
// Of steps, whose changes of profile one word a lane remembers.
constexpr std::size_t kBlock = 32;

/// What the lanes of two packets met in each of their steps.
struct WalkLog {
  std::size_t steps = 0;
  std::vector<float> distances_m;      // step by step, lane by lane
  std::vector<std::int32_t> profiles;  // the same
  std::vector<std::uint32_t> changes;  // block by block, lane by lane: in which steps it changed

  /// Room for another block of `lanes`.
  void grow(std::size_t lanes) {
    if (distances_m.size() >= (steps + kBlock) * lanes) return;
    distances_m.resize((steps + kBlock) * lanes);
    profiles.resize((steps + kBlock) * lanes);
    changes.resize((steps / kBlock + 1) * lanes);
  }

  void append_crossings(std::size_t lane, std::size_t lanes, Crossings& crossings) const {
    for (std::size_t block = 0; block * kBlock < steps; ++block) {
      for (std::uint32_t bits = changes[block * lanes + lane]; bits != 0; bits &= bits - 1) {
        const std::size_t step = block * kBlock + static_cast<std::size_t>(std::countr_zero(bits));
        const std::size_t at = step * lanes + lane;
        crossings.all.push_back({distances_m[at], static_cast<std::uint32_t>(profiles[at])});
      }
    }
  }
};

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

/// The cells at some indices, in the low halves; what the high ones hold is not said.
HWY_INLINE Int cells_at(const std::uint16_t* HWY_RESTRICT cells, Int index) {
  const Ints ints;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  // Pairs of cells: hardware gathers 32 bits, from any address.
  return hn::GatherOffset(
      ints, reinterpret_cast<const std::int32_t*>(cells), hn::Add(index, index));
#else
  HWY_ALIGN std::int32_t at[HWY_MAX_BYTES / 4];
  hn::Store(index, ints, at);
  for (std::size_t i = 0; i < hn::Lanes(ints); ++i) at[i] = cells[at[i]];
  return hn::Load(ints, at);
#endif
}

/// One axis of a packet.
struct Axis {
  Float slope;    // without its sign
  Float inverse;  // of that
  Float behind;
  Int step;   // of the index, a cell
  Int first;  // index of the eye's cell, this axis' share
  Int cell;

  HWY_INLINE Axis(const EyeOnAxis& eye,
                  std::int32_t stride,
                  const float* slopes,
                  const std::int32_t* begins) {
    const Floats floats;
    const Ints ints;
    const Float signed_slope = hn::LoadU(floats, slopes);
    const auto falls = hn::Lt(signed_slope, hn::Zero(floats));
    const auto falls_int = hn::RebindMask(ints, falls);
    slope = hn::Abs(signed_slope);
    inverse = hn::Div(hn::Set(floats, 1.0F), hn::Max(slope, hn::Set(floats, kLeastSlope)));
    behind = hn::IfThenElse(falls, hn::Set(floats, eye.behind[1]), hn::Set(floats, eye.behind[0]));
    step = hn::IfThenElse(falls_int, hn::Set(ints, -stride), hn::Set(ints, stride));
    first = hn::Mul(
        hn::IfThenElse(falls_int, hn::Set(ints, eye.cell[1] + 1), hn::Set(ints, eye.cell[0] + 1)),
        hn::Set(ints, stride));
    cell = hn::LoadU(ints, begins);
  }

  HWY_INLINE Int index() const { return hn::Add(first, hn::Mul(cell, step)); }
  /// Where the ray leaves the cells up to `end`.
  HWY_INLINE Float leaves(Int end) const {
    return hn::Mul(hn::Sub(hn::ConvertTo(Floats(), end), behind), inverse);
  }
  /// The cell at a distance, among those from the current one up to `end`.
  HWY_INLINE Int at(Float distance, Int end) const {
    const Int there = hn::ConvertTo(Ints(), hn::Add(hn::Mul(distance, slope), behind));
    return hn::Max(cell, hn::Min(there, hn::Sub(end, hn::Set(Ints(), 1))));
  }
};

/// As many rays as the target has lanes.
struct Packet {
  Axis u;
  Axis v;
  Float distance;
  Int profile = hn::Set(Ints(), -1);
  Int ended = hn::Zero(Ints());  // not 0 where it has
  Int changes = hn::Zero(Ints());

  HWY_INLINE Packet(const ColumnGrid& grid, const ColumnRays& rays, std::size_t ray)
      : u(rays.u, 1, &rays.slope_u[ray], &rays.begin_u[ray]),
        v(rays.v, grid.stride(), &rays.slope_v[ray], &rays.begin_v[ray]),
        distance(hn::LoadU(Floats(), &rays.begins_at_m[ray])) {}

  HWY_INLINE void step(const std::uint16_t* HWY_RESTRICT cells,
                       Int stop_at,
                       Int bit,
                       float* HWY_RESTRICT distances_m,
                       std::int32_t* HWY_RESTRICT profiles) {
    const Ints ints;
    const Int zero = hn::Zero(ints);
    const Int cell = cells_at(cells, hn::Add(u.index(), v.index()));
    const Int reach = hn::And(cell, hn::Set(ints, ColumnGrid::kReachMask));
    const Int here = hn::And(hn::ShiftRight<8>(cell), hn::Set(ints, 0xFF));
    hn::StoreU(distance, Floats(), distances_m);
    hn::StoreU(here, ints, profiles);
    const auto changed = hn::And(hn::Ne(here, profile), hn::Eq(ended, zero));
    changes = hn::Or(changes, hn::IfThenElseZero(changed, bit));
    profile = here;
    const Int stops = hn::And(cell, stop_at);
    ended = hn::Or(ended, hn::Or(stops, hn::IfThenElseZero(hn::Eq(reach, zero), bit)));

    // The border's reach of 0 holds a ray where it is.
    const Int end_u = hn::Add(u.cell, reach);
    const Int end_v = hn::Add(v.cell, reach);
    const Float leaves_u = u.leaves(end_u);
    const Float leaves_v = v.leaves(end_v);
    distance = hn::Min(leaves_u, leaves_v);
    const auto across_u = hn::RebindMask(ints, hn::Le(leaves_u, leaves_v));
    u.cell = hn::IfThenElse(across_u, end_u, u.at(distance, end_u));
    v.cell = hn::IfThenElse(across_u, v.at(distance, end_v), end_v);
  }
};

/// Two packets in turn, so that one computes while the other waits for its cells.
void walk_two(const ColumnGrid& grid, const ColumnRays& rays, std::size_t ray, WalkLog& log) {
  const Ints ints;
  const std::size_t lanes = hn::Lanes(ints);
  const Int stop_at = hn::Set(ints, rays.stop_at);
  const std::uint16_t* cells = grid.cells.data();
  Packet a(grid, rays, ray);
  Packet b(grid, rays, ray + lanes);
  log.steps = 0;
  for (bool ended = false; !ended;) {
    log.grow(2 * lanes);
    Int bit = hn::Set(ints, 1);
    const std::size_t block = log.steps / kBlock;
    const std::size_t end = log.steps + kBlock;
    for (std::size_t step = log.steps; step < end && !ended; ++step) {
      float* distances_m = &log.distances_m[step * 2 * lanes];
      std::int32_t* profiles = &log.profiles[step * 2 * lanes];
      a.step(cells, stop_at, bit, distances_m, profiles);
      b.step(cells, stop_at, bit, distances_m + lanes, profiles + lanes);
      bit = hn::Add(bit, bit);
      const Int zero = hn::Zero(ints);
      ended = hn::AllFalse(ints, hn::Or(hn::Eq(a.ended, zero), hn::Eq(b.ended, zero)));
    }
    std::uint32_t* changes = &log.changes[block * 2 * lanes];
    hn::StoreU(a.changes, ints, reinterpret_cast<std::int32_t*>(changes));
    hn::StoreU(b.changes, ints, reinterpret_cast<std::int32_t*>(changes + lanes));
    a.changes = b.changes = hn::Zero(ints);
    log.steps = end;
  }
}

void walk(const ColumnGrid& grid, const ColumnRays& rays, WalkLog& log, Crossings& crossings) {
  const std::size_t lanes = 2 * hn::Lanes(Ints());
  static_assert(2 * hn::MaxLanes(Ints()) <= ColumnRays::kPadding);
  for (std::size_t ray = 0; ray < rays.count; ray += lanes) {
    walk_two(grid, rays, ray, log);
    for (std::size_t lane = 0; lane < lanes && ray + lane < rays.count; ++lane) {
      if (rays.begins_at_m[ray + lane] > 0.0F) crossings.all.push_back({});
      log.append_crossings(lane, lanes, crossings);
      crossings.first.push_back(static_cast<std::uint32_t>(crossings.all.size()));
    }
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
  std::int32_t cell;
  std::uint32_t step;
  std::uint32_t first;

  RayAxis(const EyeOnAxis& eye, int stride, float signed_slope, std::int32_t begin) {
    const std::size_t falls = signed_slope < 0.0F ? 1 : 0;
    slope = std::abs(signed_slope);
    inverse = 1.0F / std::max(slope, kLeastSlope);
    behind = eye.behind[falls];
    cell = begin;
    step = static_cast<std::uint32_t>(falls != 0 ? -stride : stride);
    first = static_cast<std::uint32_t>(eye.cell[falls] + 1) * static_cast<std::uint32_t>(stride);
  }

  std::uint32_t index() const { return first + static_cast<std::uint32_t>(cell) * step; }
  float leaves(std::int32_t end) const { return (static_cast<float>(end) - behind) * inverse; }
  std::int32_t at(float distance_m, std::int32_t end) const {
    const auto there = static_cast<std::int32_t>(distance_m * slope + behind);
    return std::max(cell, std::min(there, end - 1));
  }
};

void walk_ray(const ColumnGrid& grid,
              const ColumnRays& rays,
              std::size_t ray,
              std::vector<Crossing>& crossings) {
  RayAxis u(rays.u, 1, rays.slope_u[ray], rays.begin_u[ray]);
  RayAxis v(rays.v, grid.stride(), rays.slope_v[ray], rays.begin_v[ray]);
  float distance_m = rays.begins_at_m[ray];
  if (distance_m > 0.0F) crossings.push_back({});
  for (std::uint32_t profile = ~0U;;) {
    const std::uint16_t cell = grid.cells[u.index() + v.index()];
    const std::uint32_t here = cell >> 8;
    if (here != profile) crossings.push_back({distance_m, here});
    profile = here;
    const std::int32_t reach = cell & ColumnGrid::kReachMask;
    if (reach == 0 || (cell & rays.stop_at) != 0) return;
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

void clear(Crossings& crossings) {
  crossings.first.assign(1, 0);
  crossings.all.clear();
}

}  // namespace

void walk_columns(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  // The memory of a thread is kept from view to view.
  static thread_local WalkLog log;
  clear(crossings);
  HWY_DYNAMIC_DISPATCH(walk)(grid, rays, log, crossings);
}

void walk_columns_singly(const ColumnGrid& grid, const ColumnRays& rays, Crossings& crossings) {
  clear(crossings);
  for (std::size_t ray = 0; ray < rays.count; ++ray) {
    walk_ray(grid, rays, ray, crossings.all);
    crossings.first.push_back(static_cast<std::uint32_t>(crossings.all.size()));
  }
}

}  // namespace semview::raycast
#endif  // HWY_ONCE
