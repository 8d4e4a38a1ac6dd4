// SPDX-License-Identifier: Apache-2.0
/// What surrounds every message: headers, errors, and reading bytes that nobody vouches for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <google/protobuf/stubs/logging.h>

#include "semview/core/result.hpp"
#include "semview/v1/envelope.pb.h"

namespace semview::protocol {

inline constexpr std::size_t kMaxClientNameBytes = 64;
inline constexpr std::size_t kMaxMethodNameBytes = 64;

v1::Error to_wire(const Error& error);
/// A code that this version does not know becomes `kUnknown`.
Error from_wire(const v1::Error& error);

/// An error of a request's field.
tl::unexpected<Error> wrong_field(std::string_view field, std::string message);

/// Reads a message.
/// @errors kDataLoss: `bytes` are not one; field `what`, which the text names, too.
template <typename Message>
Result<Message> parse(std::string_view bytes, std::string_view what) {
  // What a peer sends is told to the peer, not to our standard error.
  const google::protobuf::LogSilencer silence;
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return fail(Error{ErrorCode::kDataLoss,
                      std::string(what) + ": " + std::to_string(bytes.size()) +
                          " bytes that are not a " + Message::descriptor()->full_name(),
                      std::string(what)});
  }
  return message;
}

/// The header of a request, checked.
/// @errors kDataLoss: not a header; kUnimplemented: another protocol version; kInvalidArgument:
/// method or client name missing or too long.
Status validate(const v1::RequestHeader& header);

}  // namespace semview::protocol
