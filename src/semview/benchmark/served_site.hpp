// SPDX-License-Identifier: Apache-2.0
/// The seam to a server: this module measures one, and does not know how to make one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "semview/core/result.hpp"
#include "semview/service/site.hpp"
#include "semview/similarity/weight_matrix.hpp"
#include "semview/view/score_source.hpp"
#include "semview/view/view_source.hpp"

namespace semview::benchmark {

/// A site behind a server of its own on loopback, as a client sees it.
///
/// @threads For one thread at a time.
class ServedSite {
 public:
  virtual ~ServedSite() = default;
  /// Over a connection that is open already.
  virtual ViewSource& views() = 0;
  /// Bytes of the replies to `views()` so far.
  virtual std::uint64_t received_bytes() const = 0;
  /// A client with a connection of its own, open already.
  virtual Result<std::unique_ptr<ScoreSource>> scores(
      const similarity::WeightMatrix& weights) const = 0;
};

/// Starts a server of one site with so many workers.
using Serve = std::function<Result<std::unique_ptr<ServedSite>>(std::shared_ptr<service::Site> site,
                                                                std::size_t workers)>;

}  // namespace semview::benchmark
