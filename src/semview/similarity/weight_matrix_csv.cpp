// SPDX-License-Identifier: Apache-2.0
/// The file form of WeightMatrix: docs/formats/weights.md.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "semview/similarity/text_table.hpp"
#include "semview/similarity/weight_matrix.hpp"

namespace semview::similarity {
namespace {

constexpr std::string_view kBandMin = "elevation_min_deg";
constexpr std::string_view kBandMax = "elevation_max_deg";

/// The cells of a line; a cell in double quotes may hold commas, and "" for a quote.
/// `nullopt` when a quote does not end.
std::optional<std::vector<std::string>> split(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    std::string cell;
    std::string_view rest = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (rest.starts_with('"')) {
      rest.remove_prefix(1);
      while (true) {
        const std::size_t quote = rest.find('"');
        if (quote == std::string_view::npos) return {};
        cell += rest.substr(0, quote);
        rest.remove_prefix(quote + 1);
        if (!rest.starts_with('"')) break;
        cell += '"';
        rest.remove_prefix(1);
      }
    }
    const std::size_t comma = rest.find(',');
    cell += trim(rest.substr(0, comma));
    cells.push_back(std::move(cell));
    if (comma == std::string_view::npos) return cells;
    line = rest.substr(comma + 1);
  }
}

std::string quoted(const std::string& name) {
  const bool plain = name.find_first_of(",\"#") == std::string::npos && trim(name) == name;
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

/// Collects the rows of the file band by band.
class TableReader {
 public:
  explicit TableReader(std::string_view name) : name_(name) {}

  Status line(int number_of_line, std::string_view text) {
    line_ = number_of_line;
    const auto cells = split(text);
    if (!cells) return wrong("a quote that does not end");
    return map_names_.empty() ? header(*cells) : row(*cells);
  }

  Result<WeightMatrix> finish() {
    if (map_names_.empty()) {
      return fail(ErrorCode::kInvalidArgument, fmt::format("{}: no header line", name_));
    }
    if (bands_.empty()) {
      return fail(ErrorCode::kInvalidArgument, fmt::format("{}: no rows below the header", name_));
    }
    const std::vector<std::string> observed = bands_.begin()->second.names;
    std::vector<WeightMatrix::Band> bands;
    for (auto& [range, rows] : bands_) {
      if (rows.names != observed) {
        return fail(ErrorCode::kInvalidArgument,
                    fmt::format("{}: the band {:g} to {:g} degrees has other rows than the first, "
                                "expected the same names in the same order",
                                name_,
                                range.first,
                                range.second));
      }
      bands.push_back({range.first, range.second, std::move(rows.weights)});
    }
    auto matrix = WeightMatrix::build(observed, map_names_, std::move(bands));
    if (!matrix) return with_context(std::move(matrix), name_);
    return matrix;
  }

 private:
  struct Rows {
    std::vector<std::string> names;
    std::vector<double> weights;
  };

  tl::unexpected<Error> wrong(const std::string& what) const {
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}:{}: {}", name_, line_, what));
  }

  Status header(const std::vector<std::string>& cells) {
    banded_ = cells.size() > 2 && cells[0] == kBandMin && cells[1] == kBandMax;
    const std::size_t first = name_column() + 1;
    if (cells.size() <= first) {
      return wrong("expected a header: a name for the first column, then map class names");
    }
    if (cells.size() - first > kMaxClasses + 1) {
      return wrong(
          fmt::format("{} columns, expected at most {}", cells.size() - first, kMaxClasses + 1));
    }
    map_names_.assign(cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end());
    return {};
  }

  Status row(const std::vector<std::string>& cells) {
    const std::size_t expected = name_column() + 1 + map_names_.size();
    if (cells.size() != expected) {
      return wrong(fmt::format("{} cells, expected {} as in the header", cells.size(), expected));
    }
    std::pair<double, double> range{-90.0, 90.0};
    if (banded_) {
      const std::optional<double> low = parse_number(cells[0]);
      const std::optional<double> high = parse_number(cells[1]);
      if (!low || !high) return wrong("expected a band in degrees in the first two cells");
      range = {*low, *high};
    }
    if (!bands_.contains(range) && bands_.size() >= kMaxElevationBands) {
      return wrong(fmt::format("more than {} elevation bands", kMaxElevationBands));
    }
    Rows& rows = bands_[range];
    if (rows.names.size() >= kMaxWeightRows) {
      return wrong(fmt::format("more than {} observed classes", kMaxWeightRows));
    }
    rows.names.push_back(cells[name_column()]);
    for (std::size_t i = name_column() + 1; i < cells.size(); ++i) {
      const std::optional<double> weight = parse_number(cells[i]);
      if (!weight) {
        return wrong(fmt::format("weight '{}' of {} for {}: expected a finite number",
                                 cells[i],
                                 rows.names.back(),
                                 map_names_[i - name_column() - 1]));
      }
      rows.weights.push_back(*weight);
    }
    return {};
  }

  std::size_t name_column() const { return banded_ ? 2 : 0; }

  std::string name_;
  int line_ = 0;
  bool banded_ = false;
  std::vector<std::string> map_names_;
  std::map<std::pair<double, double>, Rows> bands_;
};

}  // namespace

std::string WeightMatrix::to_csv() const {
  const bool banded = bands_.size() > 1 || bands_.front().elevation_min_deg != -90.0 ||
                      bands_.front().elevation_max_deg != 90.0;
  std::string text = banded ? fmt::format("{},{},", kBandMin, kBandMax) : std::string();
  text += "observed";
  for (const std::string& name : map_names_) text += "," + quoted(name);
  text += "\n";
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    for (std::size_t i = 0; i < observed_names_.size(); ++i) {
      if (banded) {
        text += fmt::format("{},{},", bands_[b].elevation_min_deg, bands_[b].elevation_max_deg);
      }
      text += quoted(observed_names_[i]);
      for (std::size_t j = 0; j < map_names_.size(); ++j)
        text += fmt::format(",{}", weight(b, i, j));
      text += "\n";
    }
  }
  return text;
}

Result<WeightMatrix> parse_weight_matrix(std::string_view text, std::string_view name) {
  if (text.size() > kMaxWeightFileBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("{}: {} bytes, expected at most {}", name, text.size(), kMaxWeightFileBytes));
  }
  TableReader reader(name);
  for (const TextLine& line : content_lines(text)) {
    SEMVIEW_TRY_STATUS(reader.line(line.number, line.text));
  }
  return reader.finish();
}

Result<WeightMatrix> read_weight_matrix(const std::filesystem::path& path) {
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  std::ifstream file(path, std::ios::binary);
  if (no_size || !file) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: cannot be read as a file", path.string()));
  }
  if (size > kMaxWeightFileBytes) {
    return fail(
        ErrorCode::kResourceExhausted,
        fmt::format("{}: {} bytes, expected at most {}", path.string(), size, kMaxWeightFileBytes));
  }
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parse_weight_matrix(text, path.string());
}

}  // namespace semview::similarity
