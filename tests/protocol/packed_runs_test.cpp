// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/packed_runs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "semview/protocol/view_wire.hpp"
#include "support/random_view.hpp"

namespace semview::protocol {
namespace {

using namespace std::string_literals;

/// Three columns of four rows: 7 7 7 0, the same again, 5 5 5 5.
LabelImage three_columns() {
  LabelImage labels(4, 3, 7);
  labels.at(3, 0) = labels.at(3, 1) = 0;
  for (int r = 0; r < 4; ++r) labels.at(r, 2) = 5;
  return labels;
}

LabelImage random_labels(int rows, int columns) {
  LabelImage labels(rows, columns);
  for (int c = 0; c < columns; ++c) {
    const bool repeats = c > 0 && *rc::gen::inRange(0, 2) == 0;
    for (int r = 0; r < rows; ++r) {
      labels.at(r, c) = repeats ? labels.at(r, c - 1) : *rc::gen::inRange<ClassId>(0, 3);
    }
  }
  return labels;
}

TEST(PackedRunsTest, TheBytesAreThoseOfTheDocument) {
  const std::string bytes = pack_runs(ColumnView::from_labels(three_columns()));
  EXPECT_EQ(bytes, "\x02\x00\x01\x03\x04\x04\x07\x00\x05"s);
}

TEST(PackedRunsTest, ViewsOfMoreThan255RowsTakeTwoBytesANumber) {
  const ColumnView view = ColumnView::from_labels(LabelImage(300, 2, 9));
  const std::string bytes = pack_runs(view);
  EXPECT_EQ(bytes, "\x01\x00\x00\x00\x2c\x01\x09"s);
  EXPECT_EQ(*unpack_runs(bytes, 300, 2), view);
}

TEST(PackedRunsTest, ViewsComeBackAsTheyWere) {
  ASSERT_TRUE(rc::check([] {
    const int rows = *rc::gen::element(1, 4, 30, 255, 256, 300);
    const ColumnView view = ColumnView::from_labels(random_labels(rows, *rc::gen::inRange(1, 9)));
    const Result<ColumnView> back = unpack_runs(pack_runs(view), rows, view.columns());
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == view);
  }));
}

TEST(PackedRunsTest, PlanesComeBackAsTheyWere) {
  ASSERT_TRUE(rc::check([] {
    const int rows = *rc::gen::element(1, 4, 30, 256);
    const ColumnView view = testing::random_view_with_ranges(
        *rc::gen::arbitrary<std::uint64_t>(), *rc::gen::inRange(1, 9), rows);
    const std::string planes = pack_planes(view);
    const auto back = unpack_runs(pack_runs(view), rows, view.columns(), planes);
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == view);
    RC_ASSERT(!unpack_runs(pack_runs(view), rows, view.columns(), planes + "x").has_value());
    const auto lists = from_wire(to_wire(view), rows, view.columns());
    RC_ASSERT(lists.has_value());
    RC_ASSERT(*lists == view);
  }));
}

TEST(PackedRunsTest, DamagedBytesAreRefusedOrSound) {
  ASSERT_TRUE(rc::check([] {
    const ColumnView view =
        ColumnView::from_labels(random_labels(*rc::gen::element(4, 256), *rc::gen::inRange(1, 5)));
    std::string bytes = pack_runs(view);
    for (int i = *rc::gen::inRange(1, 4); i > 0; --i) {
      bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<char>();
    }
    if (*rc::gen::inRange(0, 4) == 0) bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    const auto back = unpack_runs(bytes, view.rows(), view.columns());
    if (!back) return;
    RC_ASSERT(back->rows() == view.rows() && back->columns() == view.columns());
    RC_ASSERT(ColumnView::from_labels(back->to_labels()) == *back);
  }));
}

TEST(PackedRunsTest, BytesOfAnotherShapeAreDataLoss) {
  const std::string good = pack_runs(ColumnView::from_labels(three_columns()));
  const auto refused = [](const std::string& bytes, int rows, int columns) {
    const auto view = unpack_runs(bytes, rows, columns);
    return !view && view.error().code == ErrorCode::kDataLoss;
  };
  EXPECT_FALSE(refused(good, 4, 3));
  EXPECT_TRUE(refused(good, 5, 3));
  EXPECT_TRUE(refused(good, 4, 2));
  EXPECT_TRUE(refused(good, 300, 3));
  EXPECT_TRUE(refused(good + "x", 4, 3));
  EXPECT_TRUE(refused("", 4, 3));
  std::string bad = good;
  bad[0] = 0;  // the first column repeats none
  EXPECT_TRUE(refused(bad.substr(0, 3) + bad.substr(5, 1) + bad.substr(8), 4, 3));
}

TEST(PackedRunsTest, AFewBytesCannotAskForMuchMemory) {
  // 3600 columns that would each repeat 50 000 runs.
  std::string bytes = "\x50\xc3"s + std::string(2 * 3599, '\0');
  for (int i = 1; i <= 50'000; ++i) bytes += "\x01\x00"s;
  bytes += std::string(50'000, '\1');
  EXPECT_EQ(unpack_runs(bytes, 1024, 3600).error().code, ErrorCode::kDataLoss);
}

TEST(PackedRunsTest, APanoramaInAMessageMayBePacked) {
  v1::RunPanorama wire;
  const ColumnView view = ColumnView::from_labels(three_columns());
  wire.set_packed(pack_runs(view));
  EXPECT_EQ(*from_wire(wire, 4, 3), view);
}

}  // namespace
}  // namespace semview::protocol
