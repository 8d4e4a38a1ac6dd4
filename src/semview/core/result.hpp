// SPDX-License-Identifier: Apache-2.0
/// Expected failures as values: `Result<T>`, `Status` and `Error`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <tl/expected.hpp>

namespace semview {

// GCC 12 takes the scoped kUnknown for a shadow of the class id of that name.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
/// gRPC's status codes, the same in code and on the wire.
enum class ErrorCode : std::uint8_t {
  kCancelled = 1,
  kUnknown = 2,
  kInvalidArgument = 3,
  kDeadlineExceeded = 4,
  kNotFound = 5,
  kAlreadyExists = 6,
  kPermissionDenied = 7,
  kResourceExhausted = 8,
  kFailedPrecondition = 9,
  kAborted = 10,
  kOutOfRange = 11,
  kUnimplemented = 12,
  kInternal = 13,
  kUnavailable = 14,
  kDataLoss = 15,
  kUnauthenticated = 16,
};
#pragma GCC diagnostic pop

/// gRPC's name of a code, for example `INVALID_ARGUMENT`.
std::string_view name(ErrorCode code);

/// What was wrong with which value and what was expected; lower case, no full stop.
struct Error {
  ErrorCode code = ErrorCode::kUnknown;
  std::string message;
  std::string field = {};            ///< the request field or file key at fault, if one is
  std::string hint = {};             ///< what to do about it, if that is known
  std::uint32_t retry_after_ms = 0;  ///< > 0: the same call may succeed after this time
};

/// A value or an `Error`. Ignoring one is a compiler warning; pass it up with `SEMVIEW_TRY`.
template <typename T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

using Status = Result<void>;

/// An error to return from any function that returns a `Result`.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}
inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }

/// The error of `result` with `context: ` put before its message.
template <typename T>
tl::unexpected<Error> with_context(Result<T>&& result, std::string_view context) {
  Error error = std::move(result).error();
  error.message = std::string(context) + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace semview

#define SEMVIEW_CONCAT_INNER(a, b) a##b
#define SEMVIEW_CONCAT(a, b) SEMVIEW_CONCAT_INNER(a, b)

/// `SEMVIEW_TRY(const Scene scene, Scene::build(mesh));` declares `scene` or returns the error.
#define SEMVIEW_TRY(declaration, expression)                                              \
  auto SEMVIEW_CONCAT(semview_result_, __LINE__) = (expression);                          \
  if (!SEMVIEW_CONCAT(semview_result_, __LINE__))                                         \
    return ::semview::fail(std::move(SEMVIEW_CONCAT(semview_result_, __LINE__)).error()); \
  declaration = *std::move(SEMVIEW_CONCAT(semview_result_, __LINE__))

/// Returns the error of a `Status` expression, if it is one.
#define SEMVIEW_TRY_STATUS(expression)                           \
  do {                                                           \
    if (auto semview_status = (expression); !semview_status)     \
      return ::semview::fail(std::move(semview_status).error()); \
  } while (false)
