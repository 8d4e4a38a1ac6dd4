// SPDX-License-Identifier: Apache-2.0
#include "support/view_store_contract.hpp"

#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/memory_tier.hpp"
#include "support/temporary_folder.hpp"

namespace semview::cache {
namespace {

/// An LMDB store together with its folder.
std::shared_ptr<ViewStore> lmdb_store() {
  struct Both {
    testing::TemporaryFolder folder;
    std::shared_ptr<LmdbStore> store;
  };
  const auto both = std::make_shared<Both>();
  both->store = *LmdbStore::open({both->folder.path()});
  return {both, both->store.get()};
}

INSTANTIATE_TEST_SUITE_P(
    Tiers,
    ViewStoreContract,
    ::testing::Values(
        ViewStoreFactory{"Memory", [] { return std::make_shared<MemoryTier>(1U << 20U); }},
        ViewStoreFactory{"MemoryInShards", [] { return std::make_shared<MemoryTier>(1U << 30U); }},
        ViewStoreFactory{"Lmdb", lmdb_store}),
    [](const auto& factory) { return factory.param.name; });

}  // namespace
}  // namespace semview::cache
