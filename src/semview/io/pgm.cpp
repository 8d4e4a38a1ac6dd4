// SPDX-License-Identifier: Apache-2.0
#include "semview/io/pgm.hpp"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "semview/io/png.hpp"
#include "semview/io/text_file.hpp"

namespace semview::io {
namespace {

// A text PGM takes up to four bytes a pixel.
constexpr std::size_t kMaxBytes = std::size_t{4} * kMaxPngPixels + (std::size_t{64} << 10U);

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Reads the whole numbers of a PGM, past white space and comments.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}

  std::optional<int> next() {
    skip_space_and_comments();
    int value = 0;
    const auto [stop, status] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (status != std::errc() || value < 0) return {};
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value;
  }
  std::string_view rest() const { return text_.substr(at_); }

 private:
  void skip_space_and_comments() {
    while (at_ < text_.size() && (is_space(text_[at_]) || text_[at_] == '#')) {
      const bool comment = text_[at_] == '#';
      if (comment) {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else {
        ++at_;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

struct Header {
  int columns = 0;
  int rows = 0;
  int max_value = 0;
};

std::optional<Header> read_header(Numbers& numbers) {
  const std::optional<int> columns = numbers.next();
  const std::optional<int> rows = columns ? numbers.next() : std::nullopt;
  const std::optional<int> max_value = rows ? numbers.next() : std::nullopt;
  if (!max_value || *columns == 0 || *rows == 0 || *max_value == 0) return {};
  return Header{*columns, *rows, *max_value};
}

std::string place(const Header& header, std::size_t index) {
  const auto columns = static_cast<std::size_t>(header.columns);
  return fmt::format("row {}, column {}", index / columns, index % columns);
}

}  // namespace

Result<Image<std::uint8_t>> read_pgm(const std::filesystem::path& path) {
  SEMVIEW_TRY(const std::string text, read_text_file(path, kMaxBytes));
  const std::string file = path.string();
  const bool binary = text.starts_with("P5");
  if (!binary && !text.starts_with("P2")) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: is not a PGM (P5 or P2); convert it to PGM or PNG", file));
  }
  Numbers numbers(std::string_view(text).substr(2));
  const std::optional<Header> header = read_header(numbers);
  if (!header) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: header lacks width, height and largest value", file));
  }
  if (header->max_value > 255) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: largest value {}, expected up to 255", file, header->max_value));
  }
  if (header->columns > kMaxPngSide_px || header->rows > kMaxPngSide_px ||
      std::int64_t{header->columns} * header->rows > kMaxPngPixels) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("{}: {} x {} pixels are too many", file, header->columns, header->rows));
  }
  const auto count =
      static_cast<std::size_t>(header->rows) * static_cast<std::size_t>(header->columns);
  // One white-space byte stands between the header and binary samples.
  const std::string_view samples = numbers.rest();
  if (samples.size() < (binary ? count + 1 : 2 * count - 1)) {
    return fail(ErrorCode::kDataLoss,
                fmt::format("{}: cut short: {} bytes for {} pixels", file, samples.size(), count));
  }
  Image<std::uint8_t> image(header->rows, header->columns);
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<int> value =
        binary ? static_cast<unsigned char>(samples[i + 1]) : numbers.next();
    if (!value || *value > header->max_value) {
      return fail(ErrorCode::kDataLoss,
                  fmt::format("{}: {}: {}, expected 0 to {}",
                              file,
                              place(*header, i),
                              value ? fmt::format("value {}", *value) : "no value",
                              header->max_value));
    }
    image.pixels()[i] =
        static_cast<std::uint8_t>((*value * 255 + header->max_value / 2) / header->max_value);
  }
  return image;
}

}  // namespace semview::io
