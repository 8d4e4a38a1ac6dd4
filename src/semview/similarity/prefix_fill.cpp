// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/prefix_fill.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "semview/geometry/pose_grid.hpp"
#include "semview/similarity/prefix_table.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semview/similarity/prefix_fill.cpp"
#include <hwy/foreach_target.h>  // compiles what follows once a target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace semview::similarity::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// Weight by weight: what the other targets must equal.
void fill(const PrefixEntries& table,
          const LabelImage& labels,
          std::span<const std::int16_t* const> weights_of_row) {
  const auto residues = static_cast<std::size_t>(table.residues);
  const auto first = static_cast<std::size_t>(table.first_group);
  const auto groups = static_cast<std::size_t>(table.groups);
  const std::size_t row_entries = static_cast<std::size_t>(table.classes) * residues * table.width;
  std::array<ClassId, PoseGrid::kHeadings> seen{};
  for (int r = 0; r < labels.rows(); ++r) {
    const auto row = labels.row(r);
    for (std::size_t residue = 0; residue < residues; ++residue) {
      for (std::size_t g = 0; g < groups; ++g) seen[g] = row[(first + g) * residues + residue];
      const std::int16_t* weights = weights_of_row[static_cast<std::size_t>(r)];
      const std::int16_t* above =
          table.entries + static_cast<std::size_t>(r) * row_entries + residue * table.width;
      std::int16_t* below =
          table.entries + static_cast<std::size_t>(r + 1) * row_entries + residue * table.width;
      for (int j = 0; j < table.classes; ++j) {
        for (std::size_t g = 0; g < groups; ++g) {
          below[g] = static_cast<std::int16_t>(above[g] + weights[seen[g]]);
        }
        weights += 256;
        above += residues * table.width;
        below += residues * table.width;
      }
    }
  }
}

#else

// A weight is looked up by its label, in tables that fit a vector: the labels of the picture are
// numbered, and 16 numbers make a table of low and one of high bytes. A number that is not of a
// table has its highest bit set there, which looks up 0, so that the tables' answers are or-ed.

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<std::uint8_t, PrefixTable::kBlock> kBytes{};
constexpr hn::Repartition<std::int16_t, decltype(kBytes)> kWords{};
constexpr std::size_t kLanes = hn::MaxLanes(kBytes);

constexpr std::size_t kTableSize = 16;
constexpr std::size_t kMostTables = 16;
constexpr std::size_t kMostWidth = 128;
constexpr std::uint8_t kOfAnotherTable = 0x80;
static_assert(kMostWidth >= PoseGrid::kHeadings && kMostWidth % PrefixTable::kBlock == 0);

/// Numbers the labels of a picture that are scored from 1; 0 are those that are not, and padding.
struct Numbering {
  std::array<std::uint8_t, 256> number_of{};
  std::vector<ClassId> labels{kNoHit};

  explicit Numbering(const LabelImage& picture) {
    std::array<bool, 256> seen{};
    for (const ClassId label : picture.pixels()) seen[label] = true;
    for (std::size_t label = 1; label < kUnknown; ++label) {
      if (!seen[label]) continue;
      number_of[label] = static_cast<std::uint8_t>(labels.size());
      labels.push_back(static_cast<ClassId>(label));
    }
  }
  std::size_t tables() const { return (labels.size() + kTableSize - 1) / kTableSize; }
};

/// Weights [map class][table]: 16 low bytes, then 16 high ones.
std::vector<std::uint8_t> byte_tables(const Numbering& numbering,
                                      const std::int16_t* weights,
                                      int classes) {
  const std::size_t stride = 2 * kTableSize * numbering.tables();
  std::vector<std::uint8_t> tables(stride * static_cast<std::size_t>(classes), 0);
  for (std::size_t j = 0; j < static_cast<std::size_t>(classes); ++j) {
    for (std::size_t i = 1; i < numbering.labels.size(); ++i) {
      const auto bits = static_cast<std::uint16_t>(weights[256 * j + numbering.labels[i]]);
      std::uint8_t* const table = &tables[j * stride + i / kTableSize * 2 * kTableSize];
      table[i % kTableSize] = static_cast<std::uint8_t>(bits & 0xffU);
      table[kTableSize + i % kTableSize] = static_cast<std::uint8_t>(bits >> 8U);
    }
  }
  return tables;
}

/// Where a group's number must lie so that low and high bytes, interleaved within 16-byte blocks,
/// come out in order.
constexpr std::size_t place_of(std::size_t group) {
  const std::size_t within = group % kLanes;
  const std::size_t half = within / (kLanes / 2);
  const std::size_t of_half = within % (kLanes / 2);
  return group - within + of_half / 8 * 16 + half * 8 + of_half % 8;
}

/// The numbers of one residue's groups in one row, for each table.
struct Numbers {
  alignas(64) std::uint8_t of_table[kMostTables][kMostWidth];
};

/// One row further down for one class and residue.
HWY_INLINE void add_weights(const Numbers& numbers,
                            const std::uint8_t* tables,
                            std::size_t count,
                            std::size_t width,
                            const std::int16_t* HWY_RESTRICT above,
                            std::int16_t* HWY_RESTRICT below) {
  for (std::size_t g = 0; g < width; g += kLanes) {
    auto low = hn::Zero(kBytes);
    auto high = hn::Zero(kBytes);
    for (std::size_t t = 0; t < count; ++t) {
      const auto number = hn::Load(kBytes, &numbers.of_table[t][g]);
      const std::uint8_t* const table = tables + t * 2 * kTableSize;
      low = hn::Or(low, hn::TableLookupBytesOr0(hn::LoadDup128(kBytes, table), number));
      high =
          hn::Or(high, hn::TableLookupBytesOr0(hn::LoadDup128(kBytes, table + kTableSize), number));
    }
    const auto first = hn::BitCast(kWords, hn::InterleaveLower(kBytes, low, high));
    const auto second = hn::BitCast(kWords, hn::InterleaveUpper(kBytes, low, high));
    hn::Store(hn::Add(hn::Load(kWords, above + g), first), kWords, below + g);
    hn::Store(
        hn::Add(hn::Load(kWords, above + g + kLanes / 2), second), kWords, below + g + kLanes / 2);
  }
}

HWY_ATTR void fill(const PrefixEntries& table,
                   const LabelImage& labels,
                   std::span<const std::int16_t* const> weights_of_row) {
  const Numbering numbering(labels);
  const std::size_t count = numbering.tables();
  const auto residues = static_cast<std::size_t>(table.residues);
  const auto classes = static_cast<std::size_t>(table.classes);
  const std::size_t class_stride = residues * table.width;
  const std::size_t row_stride = classes * class_stride;
  std::map<const std::int16_t*, std::vector<std::uint8_t> > tables_of;  // one a band
  Numbers numbers;
  std::fill_n(&numbers.of_table[0][0], kMostTables * kMostWidth, kOfAnotherTable);
  for (int r = 0; r < labels.rows(); ++r) {
    const std::int16_t* const weights = weights_of_row[static_cast<std::size_t>(r)];
    std::vector<std::uint8_t>& tables = tables_of[weights];
    if (tables.empty()) tables = byte_tables(numbering, weights, table.classes);
    const auto row = labels.row(r);
    for (std::size_t residue = 0; residue < residues; ++residue) {
      const auto first = static_cast<std::size_t>(table.first_group);
      for (std::size_t g = 0; g < static_cast<std::size_t>(table.groups); ++g) {
        const std::size_t number = numbering.number_of[row[(first + g) * residues + residue]];
        for (std::size_t t = 0; t < count; ++t) {
          numbers.of_table[t][place_of(g)] = number / kTableSize == t
                                                 ? static_cast<std::uint8_t>(number % kTableSize)
                                                 : kOfAnotherTable;
        }
      }
      const std::int16_t* const above =
          table.entries + static_cast<std::size_t>(r) * row_stride + residue * table.width;
      std::int16_t* const below =
          table.entries + static_cast<std::size_t>(r + 1) * row_stride + residue * table.width;
      for (std::size_t j = 0; j < classes; ++j) {
        add_weights(numbers,
                    tables.data() + j * 2 * kTableSize * count,
                    count,
                    table.width,
                    above + j * class_stride,
                    below + j * class_stride);
      }
    }
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace semview::similarity::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace semview::similarity {

HWY_EXPORT(fill);

void fill_prefix_entries(const PrefixEntries& table,
                         const LabelImage& labels,
                         std::span<const std::int16_t* const> weights_of_row) {
  HWY_DYNAMIC_DISPATCH(fill)(table, labels, weights_of_row);
}

}  // namespace semview::similarity
#endif  // HWY_ONCE
