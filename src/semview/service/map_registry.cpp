// SPDX-License-Identifier: Apache-2.0
#include "semview/service/map_registry.hpp"

#include <fmt/format.h>

#include "semview/service/site.hpp"

namespace semview::service {

Status MapRegistry::add(std::shared_ptr<Site> site) {
  const std::string id = site->id();
  if (!sites_.try_emplace(id, std::move(site)).second) {
    return fail(Error{ErrorCode::kAlreadyExists,
                      fmt::format("two maps have the id {}", id),
                      {},
                      "give one of them another id: --map ID=DIR"});
  }
  return {};
}

Result<std::shared_ptr<Site>> MapRegistry::find(std::string_view id) const {
  if (const auto found = sites_.find(id); found != sites_.end()) return found->second;
  std::string known;
  for (const auto& [name, site] : sites_) known += (known.empty() ? "" : ", ") + name;
  return fail(Error{ErrorCode::kNotFound,
                    fmt::format("no map {}; there is {}", id, known.empty() ? "none" : known),
                    "map_id"});
}

std::vector<std::shared_ptr<Site>> MapRegistry::sites() const {
  std::vector<std::shared_ptr<Site>> list;
  for (const auto& [id, site] : sites_) list.push_back(site);
  return list;
}

}  // namespace semview::service
