// SPDX-License-Identifier: Apache-2.0
/// How long work is expected to take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

#include "semview/core/clock.hpp"

namespace semview::server {

/// An amount of work, and how long one worker takes for it.
struct Work {
  std::uint64_t cells = 0;
  Duration time{};

  Work& operator+=(const Work& more);
  Work& operator-=(const Work& less);
};

/// What requests have cost lately, by client and method; the older, the less it counts.
///
/// Cells alone do not tell: to score one takes a microsecond or ten, to cast it first twenty or a
/// thousand. The best guess at a client's next request are its own last ones of that method; one
/// that has made none is taken for the mean of all clients.
/// @threads All members from several threads at once.
class WorkCosts {
 public:
  /// A request was planned, which was so much work, and turned out to be of `cells` more.
  void add_request(const std::string& client,
                   const std::string& method,
                   const Work& planning,
                   std::uint64_t cells);
  /// Some of these cells were done.
  void add_part(const std::string& client, const std::string& method, const Work& part);

  /// A request whose body nobody has looked at yet: planning and cells; nothing if none was ever
  /// planned.
  Work of_request(const std::string& client, const std::string& method) const;
  /// The same, for a SetObservation with the Score that follows: nobody has use for one alone.
  Work of_purpose(const std::string& client, const std::string& method) const;
  /// So many of its cells.
  Work of_part(const std::string& client, const std::string& method, std::uint64_t cells) const;

 private:
  /// Sums in which what was added last has weight 1, and each before it a little less.
  struct Cost {
    double requests = 0.0;
    double planning_cells = 0.0, planning_s = 0.0;  ///< of these
    double cells = 0.0;                             ///< that they came to
    double done_cells = 0.0, done_s = 0.0;          ///< of parts

    /// Was one such request planned, and part of it done if there was something to do?
    bool known() const { return requests > 0.0 && (cells == 0.0 || done_cells > 0.0); }
    double cell_s() const { return done_cells == 0.0 ? 0.0 : done_s / done_cells; }
  };
  using Costs = std::unordered_map<std::string, Cost>;

  static std::string key(const std::string& client, const std::string& method);
  Cost& of_client(const std::string& client, const std::string& method);
  const Cost* find(const std::string& client, const std::string& method) const;

  mutable std::mutex mutex_;
  Costs by_method_;
  Costs by_client_;  ///< and method: `key`
};

}  // namespace semview::server
