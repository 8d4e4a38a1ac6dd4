// SPDX-License-Identifier: Apache-2.0
/// JPEG files for tests.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

#include "semview/geometry/image.hpp"

namespace semview::testing {

/// `exif_orientation` 0: no EXIF block.
inline std::string jpeg_bytes(const RgbImage& image,
                              int exif_orientation = 0,
                              bool progressive = false) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &bytes, &size);
  codec.image_width = static_cast<unsigned>(image.columns());
  codec.image_height = static_cast<unsigned>(image.rows());
  codec.input_components = 3;
  codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, 100, TRUE);
  // Colours at full resolution, so that a pixel comes back as it was but for rounding.
  codec.comp_info[0].h_samp_factor = codec.comp_info[0].v_samp_factor = 1;
  if (progressive) jpeg_simple_progression(&codec);
  jpeg_start_compress(&codec, TRUE);
  if (exif_orientation != 0) {
    std::vector<unsigned char> exif{'E',  'x',  'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1,
                                    0x01, 0x12, 0,   3,   0, 0, 0,   1,   0, 0,  0, 0, 0, 0, 0, 0};
    exif[25] = static_cast<unsigned char>(exif_orientation);
    jpeg_write_marker(&codec, JPEG_APP0 + 1, exif.data(), static_cast<unsigned>(exif.size()));
  }
  for (int row = 0; row < image.rows(); ++row) {
    // libjpeg only reads from it.
    auto* samples =
        const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(image.row(row).data()));
    jpeg_write_scanlines(&codec, &samples, 1);
  }
  jpeg_finish_compress(&codec);
  std::string text(reinterpret_cast<char*>(bytes), size);
  jpeg_destroy_compress(&codec);
  std::free(bytes);
  return text;
}

}  // namespace semview::testing
