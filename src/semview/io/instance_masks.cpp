// SPDX-License-Identifier: Apache-2.0
#include "semview/io/instance_masks.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
constexpr std::string_view kHeader = "mask,class,score";

struct InstanceMask {
  std::string where;  ///< file and line
  std::string file;
  ClassId label = kNoHit;
  double score = 0.0;
};

Result<InstanceMask> parse_mask(std::string_view line,
                                const std::string& where,
                                const ClassTable& classes) {
  const auto wrong = [&](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: {}", where, what));
  };
  const std::size_t first = line.find(',');
  const std::size_t last = line.rfind(',');
  if (first == std::string_view::npos || first == last) return wrong("expected mask,class,score");
  InstanceMask mask{where, std::string(line.substr(0, first)), kNoHit, 0.0};
  const std::string_view name = line.substr(first + 1, last - first - 1);
  const std::optional<ClassId> label = classes.id(name);
  if (!label) return wrong(fmt::format("class '{}' is none of the log's", name));
  mask.label = *label;
  const std::string_view score = line.substr(last + 1);
  const auto [stop, status] =
      std::from_chars(score.data(), score.data() + score.size(), mask.score);
  const bool whole = status == std::errc() && stop == score.data() + score.size();
  if (!whole || !(mask.score >= 0.0 && mask.score <= 1.0)) {
    return wrong(fmt::format("score '{}': expected a number from 0 to 1", score));
  }
  return mask;
}

Result<std::vector<InstanceMask>> read_list(const std::filesystem::path& list,
                                            const ClassTable& classes) {
  SEMVIEW_TRY(const std::string text, read_text_file(list, kMaxBytes));
  std::vector<InstanceMask> masks;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string where = fmt::format("{}:{}", list.string(), line_number);
    if (line_number == 1) {
      if (line == kHeader) continue;
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: expected the header {}", where, kHeader));
    }
    if (line.empty()) continue;
    SEMVIEW_TRY(InstanceMask mask, parse_mask(line, where, classes));
    masks.push_back(std::move(mask));
  }
  return masks;
}

}  // namespace

Result<LabelImage> read_instance_masks(const std::filesystem::path& list,
                                       const ClassTable& classes) {
  SEMVIEW_TRY(std::vector<InstanceMask> masks, read_list(list, classes));
  std::ranges::stable_sort(masks, std::ranges::greater(), &InstanceMask::score);
  LabelImage labels;
  for (const InstanceMask& mask : masks) {
    SEMVIEW_TRY(const Image<std::uint8_t> covered, read_png_grey(list.parent_path() / mask.file));
    if (labels.empty()) labels = LabelImage(covered.rows(), covered.columns(), kNoHit);
    if (covered.rows() != labels.rows() || covered.columns() != labels.columns()) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("{}: a mask of {} x {} pixels, another has {} x {}",
                              mask.where,
                              covered.columns(),
                              covered.rows(),
                              labels.columns(),
                              labels.rows()));
    }
    for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
      if (labels.pixels()[i] == kNoHit && covered.pixels()[i] != 0) labels.pixels()[i] = mask.label;
    }
  }
  return labels;
}

}  // namespace semview::io
