// SPDX-License-Identifier: Apache-2.0
/// Map bundles drawn with characters, in a temporary folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "semview/geometry/image.hpp"
#include "semview/map/column_map.hpp"

namespace semview::map::testing {

/// A folder that is gone when the test is over.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// `#` wall, `.` floor, `D` door, `W` window, `T` table, ` ` outside; `?` no class's colour.
RgbImage drawing(const std::vector<std::string>& rows);

/// The colours of `drawing`.
Rgb color_of(char c);

/// The file that goes with `drawing`, 0.1 m a pixel, ceiling 2.6 m; its classes are, in order:
/// ceiling floor wall door window table.
std::string map_yaml();

/// `text` with the first `from` replaced by `to`; fails the test if there is none.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Writes map.yaml and labels.png.
void write_bundle(const std::filesystem::path& folder,
                  const std::vector<std::string>& rows,
                  const std::string& yaml = map_yaml());

void write_text(const std::filesystem::path& path, const std::string& text);

/// A closed room of 10 × 8 pixels with a door, a window and a table; the rest of 12 × 10 outside.
std::vector<std::string> room();

/// Columns drawn directly: `#` a wall up to 2.6 m, `.` ground, `D` a passable wall, `t` a slab of
/// 0.7 to 0.75 m, ` ` outside. Pixels of `resolution_m`, ceiling at 2.6 m.
ColumnMap columns(const std::vector<std::string>& rows,
                  double resolution_m = 0.1,
                  const Pose2& origin = {});

}  // namespace semview::map::testing
