// SPDX-License-Identifier: Apache-2.0
#include "semview/map/fingerprint.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "map/bundle.hpp"
#include "semview/io/png.hpp"

namespace semview::map {
namespace {

using testing::color_of;
using testing::drawing;
using testing::map_yaml;
using testing::replaced;
using testing::room;
using testing::TempFolder;
using testing::write_bundle;

class FingerprintTest : public ::testing::Test {
 protected:
  Fingerprint of(const std::string& yaml, const std::vector<std::string>& rows = room()) {
    write_bundle(folder_.path(), rows, yaml);
    return loaded();
  }
  Fingerprint loaded() {
    const Result<SemanticMap> map = load_map(folder_.path());
    EXPECT_TRUE(map) << map.error().message;
    return map ? map->fingerprint : Fingerprint{};
  }
  TempFolder& folder() { return folder_; }

 private:
  TempFolder folder_;

 protected:
  const Fingerprint base_ = of(map_yaml());
};

TEST_F(FingerprintTest, TheSamePictureInAnotherEncodingIsTheSameMap) {
  const RgbImage image = drawing(room());
  std::vector<unsigned char> rgba;
  for (const Rgb& pixel : image.pixels()) {
    rgba.insert(rgba.end(), {pixel.r, pixel.g, pixel.b, static_cast<unsigned char>(255)});
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.columns());
  png.height = static_cast<png_uint_32>(image.rows());
  png.format = PNG_FORMAT_RGBA;
  const std::string path = (folder() / "labels.png").string();
  ASSERT_NE(png_image_write_to_file(&png, path.c_str(), 0, rgba.data(), 0, nullptr), 0);
  EXPECT_EQ(loaded(), base_);

  // Palette: one entry a class, indices in the order of appearance.
  const std::string kinds = " #W.TD";
  std::vector<unsigned char> palette;
  for (const char kind : kinds) {
    const Rgb color = color_of(kind);
    palette.insert(palette.end(), {color.r, color.g, color.b});
  }
  std::vector<unsigned char> indices;
  for (const std::string& row : room()) {
    for (const char kind : row) indices.push_back(static_cast<unsigned char>(kinds.find(kind)));
  }
  png.format = PNG_FORMAT_RGB_COLORMAP;
  png.colormap_entries = static_cast<png_uint_32>(kinds.size());
  ASSERT_NE(png_image_write_to_file(&png, path.c_str(), 0, indices.data(), 0, palette.data()), 0);
  EXPECT_EQ(loaded(), base_);
}

TEST_F(FingerprintTest, WhatDoesNotChangeViewsDoesNotChangeIt) {
  EXPECT_EQ(of(replaced(map_yaml(), "test_room", "other")), base_);
  EXPECT_EQ(of(replaced(map_yaml(), "Test room", "Other")), base_);
  EXPECT_EQ(of(replaced(map_yaml(), "movable: 0.5", "movable: 0.7")), base_);
  EXPECT_EQ(of(replaced(map_yaml(), "resolution: 0.1", "resolution: 1.0e-1")), base_);
  EXPECT_EQ(of(replaced(map_yaml(), "2.0, 0.0]", "2.0, -0.0]")), base_);
  EXPECT_EQ(of("# a comment\n" + map_yaml()), base_);
}

TEST_F(FingerprintTest, AnotherColourForAClassIsTheSameMap) {
  write_bundle(folder().path(), room(), replaced(map_yaml(), "[255, 6, 82]", "[9, 9, 9]"));
  RgbImage image = drawing(room());
  for (Rgb& pixel : image.pixels()) {
    if (pixel == color_of('T')) pixel = {9, 9, 9};
  }
  ASSERT_TRUE(io::write_png(folder() / "labels.png", image));
  EXPECT_EQ(loaded(), base_);
}

TEST_F(FingerprintTest, WhatChangesViewsOrTheirMeaningChangesIt) {
  EXPECT_NE(of(replaced(map_yaml(), "max_height: 0.75", "max_height: 0.76")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "resolution: 0.1", "resolution: 0.11")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "[-1.0, 2.0", "[-1.1, 2.0")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "2.0, 0.0]", "2.0, 0.1]")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "height: 2.6}", "height: 2.7}")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "name: table", "name: desk")), base_);
  EXPECT_NE(of(replaced(map_yaml(), "above: wall}", "above: wall, passable: false}")), base_)
      << "free cells change";
  std::vector<std::string> rows = room();
  rows[3][3] = 'T';
  EXPECT_NE(of(map_yaml(), rows), base_);
}

TEST_F(FingerprintTest, MeshesDifferByGeometryAndLabels) {
  SemanticMap map;
  map.classes = ClassTable({"floor", "wall"});
  MeshGeometry geometry;
  geometry.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  geometry.mesh.triangles = {{0, 1, 2}};
  geometry.mesh.labels = {1};
  map.geometry = geometry;
  const Fingerprint base = fingerprint_of(map);
  geometry.file = "elsewhere.glb";
  map.geometry = geometry;
  EXPECT_EQ(fingerprint_of(map), base);
  geometry.mesh.labels = {2};
  map.geometry = geometry;
  EXPECT_NE(fingerprint_of(map), base);
  geometry.mesh.labels = {1};
  geometry.mesh.vertices[1].x() = 1.5F;
  map.geometry = geometry;
  EXPECT_NE(fingerprint_of(map), base);
}

}  // namespace
}  // namespace semview::map
