// SPDX-License-Identifier: Apache-2.0
/// Assertions for programmer errors. No input, file or peer may be able to trigger one.
#pragma once

namespace semview::detail {
[[noreturn]] void check_failed(const char* condition, const char* file, int line);
}

/// Always checked; keep it out of hot loops.
#define SEMVIEW_CHECK(condition)      \
  ((condition) ? static_cast<void>(0) \
               : ::semview::detail::check_failed(#condition, __FILE__, __LINE__))

/// Checked in builds without NDEBUG.
#ifdef NDEBUG
#define SEMVIEW_ASSERT(condition) static_cast<void>(0)
#else
#define SEMVIEW_ASSERT(condition) SEMVIEW_CHECK(condition)
#endif
