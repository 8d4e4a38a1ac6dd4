// SPDX-License-Identifier: Apache-2.0
/// One loaded map, ready to answer: its engine, its cells and its cached views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "semview/core/result.hpp"
#include "semview/core/thread_pool.hpp"
#include "semview/view/view_source.hpp"

namespace semview::map {
class CellGrid;
struct SemanticMap;
}  // namespace semview::map

namespace semview::raycast {
struct Panorama;
struct PanoramaRequest;
struct PinholeRequest;
struct PinholeView;
class Scene;
}  // namespace semview::raycast

namespace semview::cache {
struct Keyspace;
class LmdbStore;
class ViewCache;
}  // namespace semview::cache

namespace semview::service {

class FieldLikelihoods;

/// How a map's views are made and kept.
struct SiteConfig {
  ViewProfile profile = {};
  std::string engine = "auto";                                ///< "auto", "columns" or "embree"
  std::optional<std::filesystem::path> cache_directory = {};  ///< none: memory only
  std::uint64_t cache_limit_bytes = 0;  ///< of the directory; 0: as far as the disk goes
  /// Budget of the views in memory; those of distorted maps have an eighth of it.
  std::uint64_t memory_bytes = std::uint64_t{512} << 20U;
  std::size_t threads = 0;      ///< 0: one a core
  bool nearest_colour = false;  ///< plans with anti-aliased drawings
};

/// @errors kInvalidArgument, with the option of the command line as the error's field.
Status validate(const SiteConfig& config);

/// What the sites of one process share: one pool, one memory budget, one cache directory.
struct SharedTiers {
  std::shared_ptr<ThreadPool> pool;
  std::shared_ptr<cache::ViewCache> cache;
  std::shared_ptr<cache::LmdbStore> store;  ///< null without a cache directory

  /// @errors those of `validate` and of `cache::LmdbStore::open`.
  static Result<SharedTiers> open(const SiteConfig& config);
};

/// Which engine casts a site's views, and why.
struct EngineChoice {
  std::string name;
  std::uint32_t version = 0;
  std::string reason;
};

/// One map with everything that is needed to answer questions about it.
///
/// @threads All const members, and `views().views(…)`, from several threads at once.
class Site {
 public:
  /// Loads the map at `path` (bundle folder, map.yaml or .glb). `id` replaces the map's own id
  /// unless it is empty. `tiers` may be shared with other sites.
  /// @errors those of map::load_map; kInvalidArgument: profile or engine.
  static Result<std::shared_ptr<Site>> open(const std::filesystem::path& path,
                                            const std::string& id,
                                            const SiteConfig& config,
                                            SharedTiers tiers);
  /// Of a map that is loaded already. @errors as `open` without those of loading
  static Result<std::shared_ptr<Site>> of(map::SemanticMap map,
                                          const SiteConfig& config,
                                          SharedTiers tiers);
  /// `open` with tiers of its own.
  static Result<std::shared_ptr<Site>> open(const std::filesystem::path& path,
                                            const SiteConfig& config);
  ~Site();
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  const std::string& id() const;
  const map::SemanticMap& map() const;
  /// Free cells and cells with an eye at the profile's eye height.
  const map::CellGrid& cells() const;
  /// The engine of views of cells.
  const EngineChoice& engine() const;
  const ViewProfile& profile() const;
  /// What the records of this site's views are filed under.
  const cache::Keyspace& keyspace() const;
  /// The triangles that Embree casts.
  const raycast::Scene& scene() const;

  /// Cached views of any cell: a cell without an eye has the view of its nearest neighbour with
  /// one (docs/conventions.md#view-of-a-cell), null if there is none.
  ViewSource& views() const;
  /// Views straight from the engine, without cache and without the rule of the nearest eye.
  ViewSource& engine_views() const;

  /// Height of an eye in frame `map`.
  double eye_z_m(double eye_height_m) const;
  /// What casts a view of exactly this pose: the engine of cells but for panoramas from where no
  /// cell has its eye, inside a slab or above the ceiling. There engines differ
  /// (docs/columns.md), and Embree casts them all. Pinhole views are Embree's always.
  EngineChoice panorama_engine(const raycast::PanoramaRequest& request) const;
  EngineChoice pinhole_engine() const;
  /// Views of exactly this pose, not of its cell; never cached.
  /// @errors kInvalidArgument: pose or camera; kResourceExhausted: above the limit of pixels.
  Result<raycast::Panorama> exact_panorama(const raycast::PanoramaRequest& request) const;
  Result<raycast::PinholeView> exact_pinhole(const raycast::PinholeRequest& request) const;

  /// What scores depth images.
  FieldLikelihoods& likelihoods() const;

  ThreadPool& pool() const;
  const SharedTiers& tiers() const;

 private:
  struct Parts;
  explicit Site(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace semview::service
