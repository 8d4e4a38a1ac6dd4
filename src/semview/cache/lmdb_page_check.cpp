// SPDX-License-Identifier: Apache-2.0
#include "semview/cache/lmdb_page_check.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace semview::cache::detail {
namespace {

// LMDB's structures, by their layout in the file.
struct PageHead {
  std::uint64_t number;
  std::uint16_t padding;
  std::uint16_t flags;
  std::uint16_t lower;  // end of the node pointers; both halves: pages of an overflow run
  std::uint16_t upper;  // begin of the nodes
};
struct Table {
  std::uint32_t page_bytes;  // in the table of free pages
  std::uint16_t flags;
  std::uint16_t depth;
  std::uint64_t branch_pages;
  std::uint64_t leaf_pages;
  std::uint64_t overflow_pages;
  std::uint64_t entries;
  std::uint64_t root;
};
struct Meta {
  std::uint32_t magic;
  std::uint32_t version;
  std::uint64_t address;
  std::uint64_t map_bytes;
  Table free_pages;
  Table main;
  std::uint64_t last_page;
  std::uint64_t transaction;
};
struct NodeHead {
  std::uint16_t low;  // of the data's size; in a branch, of the child's page
  std::uint16_t high;
  std::uint16_t flags;  // in a branch, the child's page continued
  std::uint16_t key_bytes;
};
static_assert(sizeof(PageHead) == 16 && sizeof(Table) == 48 && sizeof(Meta) == 136 &&
              sizeof(NodeHead) == 8 && std::endian::native == std::endian::little);

constexpr std::uint32_t kMagic = 0xBEEFC0DE;
constexpr std::uint32_t kVersion = 1;
constexpr std::uint16_t kBranch = 0x01, kLeaf = 0x02, kOverflow = 0x04, kMeta = 0x08;
constexpr std::uint16_t kBigData = 0x01, kSubTable = 0x02;  // flags of a leaf's node
constexpr std::uint16_t kIntegerKey = 0x08;                 // flag of the table of free pages
constexpr std::uint64_t kNoRoot = ~std::uint64_t{0};
constexpr std::uint16_t kMaxDepth = 32;
constexpr std::size_t kMaxKeyBytes = 511;
/// LMDB need not write pages that a transaction took and gave back, so a sound file may end early,
/// by no more than one transaction's pages.
constexpr std::uint64_t kUnwrittenBytes = std::uint64_t{64} << 20U;

enum class Role { kFreePages, kMain, kNamed };

template <typename T>
T read(std::span<const std::byte> bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

tl::unexpected<Error> damaged(std::uint64_t page, std::string_view what) {
  return fail(ErrorCode::kDataLoss, fmt::format("page {}: {}", page, what));
}

std::optional<Meta> meta_of(std::span<const std::byte> page) {
  if (page.size() < sizeof(PageHead) + sizeof(Meta)) return {};
  const Meta meta = read<Meta>(page, sizeof(PageHead));
  if (read<PageHead>(page, 0).flags != kMeta || meta.magic != kMagic || meta.version != kVersion) {
    return {};
  }
  return meta;
}

/// A node of a page: its key and what follows it.
struct Node {
  NodeHead head;
  std::span<const std::byte> key;
  std::span<const std::byte> rest;  // to the end of the page
  std::size_t data_bytes() const { return head.low | std::size_t{head.high} << 16U; }
  std::uint64_t child() const { return data_bytes() | std::uint64_t{head.flags} << 32U; }
};

class PageWalk {
 public:
  PageWalk(std::span<const std::byte> file, const Meta& meta)
      : file_(file),
        meta_(meta),
        page_bytes_(meta.free_pages.page_bytes),
        claimed_(std::min(meta.last_page + 1, file.size() / page_bytes_)) {}

  Status run() {
    SEMVIEW_TRY_STATUS(walk_table(meta_.free_pages, Role::kFreePages));
    SEMVIEW_TRY_STATUS(walk_table(meta_.main, Role::kMain));
    for (const std::uint64_t page : free_) {
      if (page < claimed_.size() && claimed_[page]) return damaged(page, "both free and in use");
    }
    return {};
  }

 private:
  Status walk_table(const Table& table, Role role) {
    const std::uint16_t flags = role == Role::kFreePages ? kIntegerKey : 0;
    if (table.flags != flags || table.depth > kMaxDepth) {
      return damaged(table.root, "its table's description is wrong");
    }
    if (table.root == kNoRoot) return {};
    return walk_page(table.root, table.depth, role);
  }

  /// `height`: 1 for leaves.
  Status walk_page(std::uint64_t number, int height, Role role) {
    SEMVIEW_TRY_STATUS(claim(number, 1));
    const std::span<const std::byte> page = file_.subspan(number * page_bytes_, page_bytes_);
    const auto head = read<PageHead>(page, 0);
    if (head.number != number) {
      return damaged(number, fmt::format("calls itself page {}", head.number));
    }
    if (height < 1 || head.flags != (height > 1 ? kBranch : kLeaf)) {
      return damaged(number, fmt::format("has flags {:#x} at height {}", head.flags, height));
    }
    if (head.lower <= sizeof(PageHead) || head.lower % 2 != 0 || head.lower > head.upper ||
        head.upper > page_bytes_) {
      return damaged(number, "its list of nodes is out of bounds");
    }
    std::optional<Node> last;
    std::size_t used = 0;
    for (std::size_t at = sizeof(PageHead); at < head.lower; at += 2) {
      SEMVIEW_TRY(const Node node, node_at(page, head, at, height > 1));
      const bool first = !last.has_value();
      // The first key of a branch stands for all that are lower, and is not looked at.
      if (!first && !(height > 1 && at == sizeof(PageHead) + 2) && !in_order(*last, node, role)) {
        return damaged(number, "its keys are out of order");
      }
      last = node;
      SEMVIEW_TRY(const std::size_t data,
                  height > 1 ? walk_child(node, height, role) : walk_leaf(number, node, role));
      used += (sizeof(NodeHead) + node.key.size() + data + 1) & ~std::size_t{1};
    }
    if (used > page_bytes_ - head.upper) return damaged(number, "its nodes overlap");
    return {};
  }

  Result<Node> node_at(std::span<const std::byte> page,
                       const PageHead& head,
                       std::size_t pointer,
                       bool branch) const {
    const std::size_t at = read<std::uint16_t>(page, pointer);
    if (at < head.upper || at + sizeof(NodeHead) > page.size()) {
      return damaged(head.number, "a node lies out of bounds");
    }
    const auto node = read<NodeHead>(page, at);
    const std::span<const std::byte> rest = page.subspan(at + sizeof(NodeHead));
    if (node.key_bytes > std::min(kMaxKeyBytes, rest.size()) || (!branch && node.key_bytes == 0)) {
      return damaged(head.number, "a key is too long or empty");
    }
    return Node{node, rest.first(node.key_bytes), rest.subspan(node.key_bytes)};
  }

  static bool in_order(const Node& before, const Node& after, Role role) {
    if (role != Role::kFreePages) {
      return std::ranges::lexicographical_compare(before.key, after.key);
    }
    return before.key.size() == sizeof(std::uint64_t) && after.key.size() == before.key.size() &&
           read<std::uint64_t>(before.key, 0) < read<std::uint64_t>(after.key, 0);
  }

  /// @returns the bytes that the node's data takes in its page.
  Result<std::size_t> walk_child(const Node& node, int height, Role role) {
    SEMVIEW_TRY_STATUS(walk_page(node.child(), height - 1, role));
    return std::size_t{0};
  }

  /// @returns the bytes that the node's data takes in its page.
  Result<std::size_t> walk_leaf(std::uint64_t number, const Node& node, Role role) {
    const bool big = node.head.flags == kBigData;
    const bool table = node.head.flags == kSubTable && role == Role::kMain;
    if (node.head.flags != 0 && !big && !table) return damaged(number, "a node has wrong flags");
    const std::size_t inside = big ? sizeof(std::uint64_t) : node.data_bytes();
    if (inside > node.rest.size()) return damaged(number, "a value is longer than its page");
    std::span<const std::byte> data = node.rest.first(inside);
    if (big) {
      SEMVIEW_TRY(data, overflow(read<std::uint64_t>(data, 0), node.data_bytes()));
    }
    if (table) {
      if (data.size() != sizeof(Table)) return damaged(number, "a table's description is cut");
      SEMVIEW_TRY_STATUS(walk_table(read<Table>(data, 0), Role::kNamed));
    }
    if (role == Role::kFreePages) SEMVIEW_TRY_STATUS(take_free(number, data));
    return inside;
  }

  Result<std::span<const std::byte>> overflow(std::uint64_t number, std::size_t bytes) {
    if (number >= claimed_.size()) return damaged(number, "lies past the end of the file");
    const auto head = read<PageHead>(file_, number * page_bytes_);
    const std::uint64_t pages = head.lower | std::uint64_t{head.upper} << 16U;
    if (head.number != number || head.flags != kOverflow || pages == 0 ||
        sizeof(PageHead) + bytes > pages * page_bytes_) {
      return damaged(number, "is no run of pages for a long value");
    }
    SEMVIEW_TRY_STATUS(claim(number, pages));
    return file_.subspan(number * page_bytes_ + sizeof(PageHead), bytes);
  }

  /// A list of free pages: its length, then page numbers from the highest.
  Status take_free(std::uint64_t number, std::span<const std::byte> list) {
    if (list.size() < sizeof(std::uint64_t)) return damaged(number, "a list of free pages is cut");
    const auto length = read<std::uint64_t>(list, 0);
    if (length > list.size() / sizeof(std::uint64_t) - 1) {
      return damaged(number, "a list of free pages is longer than its value");
    }
    std::uint64_t above = meta_.last_page + 1;
    for (std::size_t i = 1; i <= length; ++i) {
      const auto page = read<std::uint64_t>(list, i * sizeof(std::uint64_t));
      if (page < 2 || page >= above) return damaged(number, "a list of free pages is wrong");
      free_.push_back(above = page);
    }
    return {};
  }

  Status claim(std::uint64_t number, std::uint64_t pages) {
    if (number >= claimed_.size() || pages > claimed_.size() - number) {
      return damaged(number, "lies past the end of the file");
    }
    for (std::uint64_t page = number; page < number + pages; ++page) {
      if (page < 2 || claimed_[page]) return damaged(page, "is used twice");
      claimed_[page] = true;
    }
    return {};
  }

  std::span<const std::byte> file_;
  const Meta& meta_;
  std::uint64_t page_bytes_;
  std::vector<bool> claimed_;
  std::vector<std::uint64_t> free_;
};

/// The second of the two first pages, which starts where the first one says.
std::optional<Meta> second_meta(std::span<const std::byte> file, const Meta& first) {
  const std::size_t page_bytes = first.free_pages.page_bytes;
  return page_bytes < file.size() ? meta_of(file.subspan(page_bytes)) : std::nullopt;
}

}  // namespace

bool looks_like_lmdb(std::span<const std::byte> file) {
  if (meta_of(file)) return true;
  for (std::size_t page = 512; page <= 65536 && page < file.size(); page *= 2) {
    if (meta_of(file.subspan(page))) return true;
  }
  return false;
}

Status check_pages(std::span<const std::byte> file) {
  const std::optional<Meta> first = meta_of(file);
  if (!first) return damaged(0, "does not describe the file");
  const std::uint32_t page_bytes = first->free_pages.page_bytes;
  if (!std::has_single_bit(page_bytes) || page_bytes < 512 || page_bytes > 65536) {
    return damaged(0, fmt::format("speaks of pages of {} bytes", page_bytes));
  }
  const std::optional<Meta> second = second_meta(file, *first);
  if (!second || second->free_pages.page_bytes != page_bytes) {
    return damaged(1, "does not describe the file");
  }
  // Transactions write the two in turn; the younger one counts.
  if (first->transaction % 2 != 0 || (second->transaction != 0 && second->transaction % 2 == 0)) {
    return damaged(first->transaction % 2 != 0 ? 0 : 1,
                   "is of a transaction that writes the other");
  }
  const Meta& current = first->transaction < second->transaction ? *second : *first;
  if (current.last_page < 1 || current.last_page > (file.size() + kUnwrittenBytes) / page_bytes) {
    return damaged(current.last_page, "the last one, lies far past the end of the file");
  }
  return PageWalk(file, current).run();
}

}  // namespace semview::cache::detail
