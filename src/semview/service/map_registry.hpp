// SPDX-License-Identifier: Apache-2.0
/// The maps that a server serves.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "semview/core/result.hpp"

namespace semview::service {

class Site;

/// Sites by id. Filled before it is shared; after that it does not change.
/// @threads Const members from several threads at once.
class MapRegistry {
 public:
  /// @errors kAlreadyExists: a map with this id is there.
  Status add(std::shared_ptr<Site> site);

  /// @errors kNotFound, naming the ids that there are.
  Result<std::shared_ptr<Site>> find(std::string_view id) const;

  /// In order of their ids.
  std::vector<std::shared_ptr<Site>> sites() const;

 private:
  std::map<std::string, std::shared_ptr<Site>, std::less<>> sites_;
};

}  // namespace semview::service
