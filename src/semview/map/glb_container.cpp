// SPDX-License-Identifier: Apache-2.0
#include "semview/map/glb_container.hpp"

#include <cstdint>
#include <limits>

#include <fmt/format.h>

namespace semview::map {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN\0"

std::uint32_t read_word(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  }
  return word;
}

void append_word(std::string& bytes, std::size_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>((word >> shift) & 0xFFU));
  }
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view content, char pad) {
  const std::size_t padding = (4 - content.size() % 4) % 4;
  append_word(bytes, content.size() + padding);
  append_word(bytes, type);
  bytes.append(content);
  bytes.append(padding, pad);
}

}  // namespace

Result<GlbChunks> split_glb(std::string_view bytes, std::string_view name) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes || read_word(bytes, 0) != kMagic) {
    return fail(ErrorCode::kDataLoss, fmt::format("{}: not a binary glTF file", name));
  }
  if (const std::uint32_t version = read_word(bytes, 4); version != 2) {
    return fail(ErrorCode::kUnimplemented,
                fmt::format("{}: binary glTF version {}, expected 2", name, version));
  }
  if (const std::size_t length = read_word(bytes, 8); length != bytes.size()) {
    return fail(
        ErrorCode::kDataLoss,
        fmt::format("{}: its header says {} bytes, the file has {}", name, length, bytes.size()));
  }
  GlbChunks chunks;
  std::size_t at = kHeaderBytes;
  for (int k = 0; at < bytes.size(); ++k) {
    if (bytes.size() - at < kChunkHeaderBytes ||
        bytes.size() - at - kChunkHeaderBytes < read_word(bytes, at)) {
      return fail(ErrorCode::kDataLoss,
                  fmt::format("{}: chunk {} at byte {} reaches past the end", name, k, at));
    }
    const std::uint32_t type = read_word(bytes, at + 4);
    const std::string_view content = bytes.substr(at + kChunkHeaderBytes, read_word(bytes, at));
    if (k == 0 && type != kJson) {
      return fail(ErrorCode::kDataLoss, fmt::format("{}: its first chunk is not JSON", name));
    }
    if (k == 0) chunks.json = content;
    if (k == 1 && type == kBinary) chunks.binary = content;
    at += kChunkHeaderBytes + content.size();
  }
  return chunks;
}

Result<std::string> join_glb(std::string_view json, std::string_view binary) {
  // Three bytes of padding a chunk at most.
  const std::size_t bound =
      kHeaderBytes + 2 * (kChunkHeaderBytes + 3) + json.size() + binary.size();
  if (bound > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::kInvalidArgument, "a binary glTF file holds less than 4 GiB");
  }
  std::string chunks;
  chunks.reserve(bound);
  append_chunk(chunks, kJson, json, ' ');
  if (!binary.empty()) append_chunk(chunks, kBinary, binary, '\0');
  std::string file;
  file.reserve(bound);
  append_word(file, kMagic);
  append_word(file, 2);
  append_word(file, kHeaderBytes + chunks.size());
  return file + chunks;
}

}  // namespace semview::map
