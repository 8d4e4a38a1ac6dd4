// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

// Needs std::FILE and std::size_t declared before it.
#include <fmt/format.h>
#include <jpeglib.h>

#include "semview/io/exif.hpp"
#include "semview/io/jpeg.hpp"

namespace semview::io {
namespace {

// A progressive file may repeat its scans without end; honest ones have about ten.
constexpr int kMaxScans = 200;
constexpr unsigned kMaxSegmentBytes = 0xffff;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// libjpeg leaves by longjmp, which must not skip a destructor: every call that may fail sits alone
// in a member function that holds nothing but plain values.
struct ErrorExit {
  jpeg_error_mgr base;  // first, so that libjpeg's pointer to it is ours
  std::jmp_buf leave;
  char message[JMSG_LENGTH_MAX];
};

void on_error(j_common_ptr codec) {
  auto* error = reinterpret_cast<ErrorExit*>(codec->err);
  error->base.format_message(codec, error->message);
  std::longjmp(error->leave, 1);
}

/// libjpeg repairs what it warns of with grey pixels; labels of those would be wrong.
void on_message(j_common_ptr codec, int level) {
  if (level < 0) on_error(codec);
}

void on_progress(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= kMaxScans) return;
  auto* error = reinterpret_cast<ErrorExit*>(codec->err);
  std::snprintf(error->message, sizeof error->message, "more than %d scans", kMaxScans);
  std::longjmp(error->leave, 1);
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path), file_(std::fopen(path.c_str(), "rb")) {}
  ~Reader() {
    if (made_) jpeg_destroy_decompress(&codec_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Result<RgbImage> read();

 private:
  bool step_header();
  bool step_start();
  bool step_row(unsigned char* samples);
  bool step_finish();
  Status check_header() const;
  Orientation orientation() const;
  tl::unexpected<Error> damaged(std::string_view where) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  jpeg_decompress_struct codec_{};
  jpeg_progress_mgr progress_{};
  ErrorExit error_{};
  bool made_ = false;
};

bool Reader::step_header() {
  codec_.err = jpeg_std_error(&error_.base);
  error_.base.error_exit = on_error;
  error_.base.emit_message = on_message;
  if (setjmp(error_.leave) != 0) return false;
  jpeg_create_decompress(&codec_);
  made_ = true;
  progress_.progress_monitor = on_progress;
  codec_.progress = &progress_;
  jpeg_stdio_src(&codec_, file_.get());
  jpeg_save_markers(&codec_, JPEG_APP0 + 1, kMaxSegmentBytes);
  jpeg_read_header(&codec_, TRUE);
  return true;
}

bool Reader::step_start() {
  if (setjmp(error_.leave) != 0) return false;
  codec_.out_color_space = JCS_RGB;
  // The slow transform is the exact one, and the same on every machine.
  codec_.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&codec_);
  return true;
}

bool Reader::step_row(unsigned char* samples) {
  if (setjmp(error_.leave) != 0) return false;
  JSAMPROW row = samples;
  jpeg_read_scanlines(&codec_, &row, 1);
  return true;
}

bool Reader::step_finish() {
  if (setjmp(error_.leave) != 0) return false;
  jpeg_finish_decompress(&codec_);
  return true;
}

Status Reader::check_header() const {
  const auto rows = std::int64_t{codec_.image_height};
  const auto columns = std::int64_t{codec_.image_width};
  if (rows > kMaxJpegSide_px || columns > kMaxJpegSide_px || rows * columns > kMaxJpegPixels) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: {} x {} pixels, at most {} a side and {} in all can be read",
                            path_.string(),
                            columns,
                            rows,
                            kMaxJpegSide_px,
                            kMaxJpegPixels));
  }
  if (codec_.jpeg_color_space == JCS_CMYK || codec_.jpeg_color_space == JCS_YCCK) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: is a CMYK JPEG, for printing; expected RGB or grey", path_.string()));
  }
  return {};
}

Orientation Reader::orientation() const {
  for (const jpeg_marker_struct* marker = codec_.marker_list; marker != nullptr;
       marker = marker->next) {
    if (marker->marker != JPEG_APP0 + 1) continue;
    const Orientation found = exif_orientation({marker->data, marker->data_length});
    if (found != Orientation::kUpright) return found;
  }
  return Orientation::kUpright;
}

tl::unexpected<Error> Reader::damaged(std::string_view where) const {
  const bool cut_short = std::feof(file_.get()) != 0;
  return fail(Error{
      ErrorCode::kDataLoss,
      cut_short ? fmt::format("{}: is cut short: the file ends in {}", path_.string(), where)
                : fmt::format("{}: is damaged in {} ({})", path_.string(), where, error_.message),
      {},
      "save or copy the picture again, as a PNG or JPEG"});
}

Result<RgbImage> Reader::read() {
  if (!file_) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot be opened: {}", path_.string(), std::strerror(errno)));
  }
  if (!step_header()) return damaged("its header");
  SEMVIEW_TRY_STATUS(check_header());
  const Orientation orientation = this->orientation();
  if (!step_start()) return damaged("its header");
  const int rows = static_cast<int>(codec_.output_height);
  const int columns = static_cast<int>(codec_.output_width);
  static_assert(sizeof(Rgb) == 3);
  RgbImage image(rows, columns);
  for (int row = 0; row < rows; ++row) {
    if (!step_row(reinterpret_cast<unsigned char*>(image.row(row).data()))) {
      return damaged("its pixels");
    }
  }
  if (!step_finish()) return damaged("its pixels");
  return upright(std::move(image), orientation);
}

}  // namespace

Result<RgbImage> read_jpeg(const std::filesystem::path& path) { return Reader(path).read(); }

}  // namespace semview::io
