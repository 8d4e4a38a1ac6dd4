// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/envelope.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "semview/protocol/descriptions.hpp"

namespace semview::protocol {
namespace {

/// Length of the well-formed UTF-8 sequence at the start of `text`, or 0.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
  }
  // Overlong forms, surrogates, beyond the last code point.
  const bool wrong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) ||
                     (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f);
  return wrong ? 0 : length;
}

/// A message that quotes a peer's bytes must not make the reply unreadable.
std::string utf8(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) clean.push_back('?');
    clean.append(text.substr(0, length));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

}  // namespace

v1::Error to_wire(const Error& error) {
  v1::Error wire;
  wire.set_code(static_cast<v1::ErrorCode>(error.code));
  wire.set_message(utf8(error.message));
  wire.set_field(utf8(error.field));
  wire.set_hint(utf8(error.hint));
  wire.set_retry_after_ms(error.retry_after_ms);
  return wire;
}

Error from_wire(const v1::Error& wire) {
  const int code = wire.code();
  const bool known = code >= static_cast<int>(ErrorCode::kCancelled) &&
                     code <= static_cast<int>(ErrorCode::kUnauthenticated);
  return {known ? static_cast<ErrorCode>(code) : ErrorCode::kUnknown,
          wire.message(),
          wire.field(),
          wire.hint(),
          wire.retry_after_ms()};
}

tl::unexpected<Error> wrong_field(std::string_view field, std::string message) {
  return fail(Error{
      ErrorCode::kInvalidArgument, fmt::format("{}: {}", field, message), std::string(field)});
}

Status validate(const v1::RequestHeader& header) {
  if (header.protocol_version() != kProtocolVersion) {
    return fail(Error{ErrorCode::kUnimplemented,
                      fmt::format("protocol_version: {} is not spoken here, only {}",
                                  header.protocol_version(),
                                  kProtocolVersion),
                      "protocol_version"});
  }
  if (header.method().empty() || header.method().size() > kMaxMethodNameBytes) {
    return wrong_field(
        "method",
        fmt::format(
            "{} bytes; expected a name of 1 to {}", header.method().size(), kMaxMethodNameBytes));
  }
  if (header.client_name().size() > kMaxClientNameBytes) {
    return wrong_field(
        "client_name",
        fmt::format(
            "{} bytes; expected at most {}", header.client_name().size(), kMaxClientNameBytes));
  }
  return {};
}

}  // namespace semview::protocol
