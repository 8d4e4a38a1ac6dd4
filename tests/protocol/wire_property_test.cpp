// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "semview/protocol/envelope.hpp"
#include "semview/protocol/map_wire.hpp"
#include "semview/protocol/score_wire.hpp"
#include "semview/protocol/view_wire.hpp"

namespace semview::protocol {
namespace {

LabelImage random_labels() {
  LabelImage labels(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 30));
  for (ClassId& label : labels.pixels()) label = *rc::gen::inRange<ClassId>(0, 3);
  return labels;
}

/// `bytes` with one byte changed, cut off, or added.
std::string damaged(std::string bytes) {
  if (bytes.empty()) return "\xff";
  const auto place = *rc::gen::inRange<std::size_t>(0, bytes.size());
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      bytes[place] = *rc::gen::arbitrary<char>();
      break;
    case 1:
      bytes.resize(place);
      break;
    default:
      bytes.insert(place, 1, *rc::gen::arbitrary<char>());
  }
  return bytes;
}

TEST(WirePropertyTest, APanoramaComesBackAsItWas) {
  ASSERT_TRUE(rc::check([] {
    const ColumnView view = ColumnView::from_labels(random_labels());
    v1::RunPanorama wire;
    RC_ASSERT(wire.ParseFromString(to_wire(view).SerializeAsString()));
    const Result<ColumnView> back = from_wire(wire, view.rows(), view.columns());
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == view);
  }));
}

TEST(WirePropertyTest, CellsComeBackAsTheyWere) {
  ASSERT_TRUE(rc::check([] {
    std::vector<CellIndex> cells;
    CellIndex next{*rc::gen::inRange(-50, 50), *rc::gen::inRange(-50, 50)};
    for (int i = *rc::gen::inRange(0, 60); i > 0; --i) {
      cells.push_back(next);
      if (*rc::gen::inRange(0, 5) == 0) {
        next = {*rc::gen::inRange(-50, 50), next.iy + 1};
      } else {
        next.ix += *rc::gen::inRange(1, 3);
      }
    }
    const auto back = from_wire(to_wire(std::span<const CellIndex>(cells)));
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == cells);
  }));
}

TEST(WirePropertyTest, DamagedPanoramasAreRefusedOrSound) {
  ASSERT_TRUE(rc::check([] {
    const ColumnView view = ColumnView::from_labels(random_labels());
    v1::RunPanorama wire;
    if (!wire.ParseFromString(damaged(to_wire(view).SerializeAsString()))) return;
    const Result<ColumnView> back = from_wire(wire, view.rows(), view.columns());
    if (back) {
      RC_ASSERT(back->rows() == view.rows() && back->columns() == view.columns());
      // Sound: every column can be walked to its last row.
      RC_ASSERT(ColumnView::from_labels(back->to_labels()) == *back);
    }
  }));
}

TEST(WirePropertyTest, DamagedRequestsNeverCrash) {
  ASSERT_TRUE(rc::check([] {
    Observation observation{ClassTable({"a", "b", "c"}), random_labels(), 1.0};
    v1::SetObservationRequest set;
    to_wire(observation, &set);
    ScoreRequest score{{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}, HeadingMode::kCompass, true};
    v1::ScoreRequest wire_score;
    to_wire(score, &wire_score);
    if (const auto got = parse<v1::SetObservationRequest>(damaged(set.SerializeAsString()), "b")) {
      if (const auto read = from_wire(*got)) RC_ASSERT(!read->labels.empty());
    }
    if (const auto got = parse<v1::ScoreRequest>(damaged(wire_score.SerializeAsString()), "b")) {
      if (const auto read = from_wire(*got, 100)) {
        for (const Pose2& pose : read->poses) RC_ASSERT(is_finite(pose));
      }
    }
  }));
}

TEST(WirePropertyTest, ArbitraryBytesNeverCrash) {
  ASSERT_TRUE(rc::check([](const std::string& bytes) {
    if (const auto map = parse<v1::GetMapReply>(bytes, "b")) {
      static_cast<void>(from_wire(*map).has_value());
    }
    if (const auto header = parse<v1::RequestHeader>(bytes, "b")) {
      static_cast<void>(validate(*header).has_value());
    }
    if (const auto views = parse<v1::GetViewsReply>(bytes, "b")) {
      static_cast<void>(from_wire(*views, 1).has_value());
    }
  }));
}

}  // namespace
}  // namespace semview::protocol
