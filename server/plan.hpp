// SPDX-License-Identifier: Apache-2.0
/// How a method does its work: in pieces that take their turn in the FairQueue.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::server {

/// Cells of one piece: 64 cached compass cells take half a millisecond, so no client waits long for
/// another's piece, and handing a piece over costs nothing beside it.
inline constexpr std::size_t kCellsPerChunk = 64;

struct Chunk {
  std::uint64_t cells = 1;
  std::function<Status()> run;  ///< from any worker; chunks of one plan run at once
};

/// What a request comes to: chunks in any order, then the body of the reply.
struct Plan {
  std::vector<Chunk> chunks;
  std::function<Result<std::string>()> finish;  ///< once, after all chunks have succeeded
};

/// A plan whose answer is already there.
inline Plan answer(std::string body) {
  return {{},
          [body = std::move(body)]() mutable -> Result<std::string> { return std::move(body); }};
}

}  // namespace semview::server
