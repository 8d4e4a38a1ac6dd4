// SPDX-License-Identifier: Apache-2.0
#include "semview/service/site.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "semview/cache/cache_key.hpp"
#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/memory_tier.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/map/cell_grid.hpp"
#include "semview/map/eye_place.hpp"
#include "semview/map/semantic_map.hpp"
#include "semview/raycast/embree_engine.hpp"
#include "semview/raycast/engine_choice.hpp"
#include "semview/raycast/engine_view_source.hpp"
#include "semview/raycast/mesh_cell_grid.hpp"
#include "semview/raycast/panorama_renderer.hpp"
#include "semview/raycast/pinhole_renderer.hpp"
#include "semview/raycast/scene.hpp"
#include "semview/service/cached_view_source.hpp"
#include "semview/service/field_likelihoods.hpp"
#include "semview/service/limits.hpp"
#include "semview/service/nearest_eye_view_source.hpp"

namespace semview::service {
namespace {

constexpr std::size_t kMaxThreads = 1024;

/// The name on the command line of a profile's field.
std::string option_of(const std::string& field) {
  if (field == "eye_height_m") return "--eye-height";
  return "--" + field;
}

Status check_pixels(int columns, int rows) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
  const std::uint64_t limit = Limits{}.max_pixels;
  if (pixels <= limit) return {};
  return fail(Error{
      ErrorCode::kResourceExhausted,
      fmt::format("a view of {} x {} pixels is above the limit of {} pixels", columns, rows, limit),
      "columns"});
}

Result<map::CellGrid> build_cells(const map::SemanticMap& map,
                                  const raycast::Scene& scene,
                                  double eye_height_m) {
  if (const map::ColumnMap* columns = map.columns()) {
    return map::build_cell_grid(*columns, eye_height_m);
  }
  return raycast::build_cell_grid(scene, map.ground_height_m, eye_height_m);
}

EngineChoice embree_because(std::string reason) {
  return {std::string(raycast::EmbreeEngine::kName),
          raycast::EmbreeEngine::kVersion,
          std::move(reason)};
}

/// What a person would name on the command line to look at the map.
std::string place_of(const map::SemanticMap& map) {
  return (map.mesh() != nullptr ? map.mesh()->file : map.directory).string();
}

/// Why the engine of cells does not cast this view; empty if it does.
std::string unlike_cells(const map::SemanticMap& map, const raycast::PanoramaRequest& request) {
  const map::ColumnMap* columns = map.columns();
  if (columns == nullptr) return {};
  const Pose2& eye = request.map_from_robot;
  const map::EyePlace place = map::eye_place(*columns, eye.x_m, eye.y_m, request.eye_z_m);
  if (place.in_slab) {
    return fmt::format("the eye is inside a {}, and such views are cast by Embree",
                       map.classes.name(*place.in_slab));
  }
  if (place.above_ceiling) {
    return "the eye is above the ceiling, and such views are cast by Embree";
  }
  return {};
}

}  // namespace

Status validate(const SiteConfig& config) {
  if (Status valid = validate(config.profile); !valid) {
    Error error = std::move(valid).error();
    error.field = option_of(error.field);
    return fail(std::move(error));
  }
  SEMVIEW_TRY_STATUS(raycast::check_engine_name(config.engine));
  if (config.threads > kMaxThreads) {
    return fail(Error{ErrorCode::kInvalidArgument,
                      fmt::format("threads {} must be at most {}", config.threads, kMaxThreads),
                      "--threads"});
  }
  return {};
}

Result<SharedTiers> SharedTiers::open(const SiteConfig& config) {
  SEMVIEW_TRY_STATUS(validate(config));
  SharedTiers tiers;
  if (config.cache_directory) {
    SEMVIEW_TRY(tiers.store,
                cache::LmdbStore::open({*config.cache_directory, config.cache_limit_bytes}));
  }
  tiers.pool = std::make_shared<ThreadPool>(config.threads);
  const std::uint64_t distorted_bytes = config.memory_bytes / 8;
  tiers.cache = std::make_shared<cache::ViewCache>(
      std::make_shared<cache::MemoryTier>(config.memory_bytes - distorted_bytes),
      tiers.store,
      std::make_shared<cache::MemoryTier>(distorted_bytes));
  return tiers;
}

struct Site::Parts {
  map::SemanticMap map;
  std::shared_ptr<const raycast::Scene> scene;
  std::shared_ptr<const raycast::Engine> caster;
  map::CellGrid cells;
  EngineChoice engine;
  cache::Keyspace keyspace;
  SharedTiers tiers;
  std::unique_ptr<raycast::EngineViewSource> engine_views;
  std::unique_ptr<CachedViewSource> cached_views;
  std::unique_ptr<NearestEyeViewSource> views;
  std::unique_ptr<FieldLikelihoods> likelihoods;
};

Result<std::shared_ptr<Site>> Site::open(const std::filesystem::path& path,
                                         const std::string& id,
                                         const SiteConfig& config,
                                         SharedTiers tiers) {
  SEMVIEW_TRY(map::SemanticMap map, map::load_map(path, {config.nearest_colour}));
  if (!id.empty()) map.id = id;
  return of(std::move(map), config, std::move(tiers));
}

Result<std::shared_ptr<Site>> Site::of(map::SemanticMap map,
                                       const SiteConfig& config,
                                       SharedTiers tiers) {
  SEMVIEW_TRY_STATUS(validate(config));
  auto parts = std::make_unique<Parts>();
  parts->map = std::move(map);
  Result<raycast::Scene> scene = raycast::Scene::build(parts->map);
  if (!scene) return with_context(std::move(scene), place_of(parts->map));
  parts->scene = std::make_shared<const raycast::Scene>(*std::move(scene));
  SEMVIEW_TRY(parts->cells, build_cells(parts->map, *parts->scene, config.profile.eye_height_m));
  if (!parts->cells.any_view()) {
    return fail(Error{ErrorCode::kFailedPrecondition,
                      fmt::format("map {}: from no free cell does a camera {} m above the ground "
                                  "see anything",
                                  parts->map.id,
                                  config.profile.eye_height_m),
                      "--eye-height",
                      fmt::format("semview map check --eye-height {} {} says why",
                                  config.profile.eye_height_m,
                                  place_of(parts->map))});
  }
  parts->tiers = std::move(tiers);
  SEMVIEW_TRY(raycast::EngineChoice choice,
              raycast::choose_engine(config.engine,
                                     {parts->map.id,
                                      parts->map.classes,
                                      parts->map.columns(),
                                      parts->scene,
                                      parts->cells,
                                      parts->map.ground_height_m},
                                     config.profile,
                                     *parts->tiers.pool));
  parts->caster = choice.engine;
  parts->engine = {
      std::string(choice.engine->name()), choice.engine->version(), std::move(choice.reason)};
  parts->keyspace = {
      parts->map.fingerprint, parts->engine.name, parts->engine.version, config.profile};
  SEMVIEW_TRY(parts->engine_views,
              raycast::EngineViewSource::create(
                  parts->caster, config.profile, parts->map.ground_height_m, *parts->tiers.pool));
  parts->cached_views =
      std::make_unique<CachedViewSource>(*parts->engine_views, parts->keyspace, parts->tiers.cache);
  parts->views = std::make_unique<NearestEyeViewSource>(*parts->cached_views, parts->cells);
  parts->likelihoods = std::make_unique<FieldLikelihoods>(parts->map);
  if (parts->tiers.store != nullptr) {
    parts->tiers.store->describe(
        parts->keyspace, parts->map.id, view_cells(parts->cells, parts->cells.free_cells()));
  }
  return std::shared_ptr<Site>(new Site(std::move(parts)));
}

Result<std::shared_ptr<Site>> Site::open(const std::filesystem::path& path,
                                         const SiteConfig& config) {
  SEMVIEW_TRY(SharedTiers tiers, SharedTiers::open(config));
  return open(path, {}, config, std::move(tiers));
}

Site::Site(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Site::~Site() = default;

const std::string& Site::id() const { return parts_->map.id; }
const map::SemanticMap& Site::map() const { return parts_->map; }
const map::CellGrid& Site::cells() const { return parts_->cells; }
const EngineChoice& Site::engine() const { return parts_->engine; }
const ViewProfile& Site::profile() const { return parts_->keyspace.profile; }
const cache::Keyspace& Site::keyspace() const { return parts_->keyspace; }
const raycast::Scene& Site::scene() const { return *parts_->scene; }
ViewSource& Site::views() const { return *parts_->views; }
ViewSource& Site::engine_views() const { return *parts_->engine_views; }
FieldLikelihoods& Site::likelihoods() const { return *parts_->likelihoods; }
ThreadPool& Site::pool() const { return *parts_->tiers.pool; }
const SharedTiers& Site::tiers() const { return parts_->tiers; }

double Site::eye_z_m(double eye_height_m) const {
  return parts_->map.ground_height_m + eye_height_m;
}

EngineChoice Site::panorama_engine(const raycast::PanoramaRequest& request) const {
  if (parts_->engine.name == raycast::EmbreeEngine::kName) return parts_->engine;
  std::string reason = unlike_cells(parts_->map, request);
  return reason.empty() ? parts_->engine : embree_because(std::move(reason));
}

EngineChoice Site::pinhole_engine() const {
  return embree_because("pinhole views are cast by Embree");
}

Result<raycast::Panorama> Site::exact_panorama(const raycast::PanoramaRequest& request) const {
  SEMVIEW_TRY_STATUS(raycast::validate(request));
  SEMVIEW_TRY_STATUS(check_pixels(request.camera.columns, request.camera.rows));
  if (panorama_engine(request).name == parts_->engine.name) {
    return parts_->caster->panorama(request);
  }
  return raycast::render_panorama(*parts_->scene, request);
}

Result<raycast::PinholeView> Site::exact_pinhole(const raycast::PinholeRequest& request) const {
  SEMVIEW_TRY_STATUS(raycast::validate(request));
  SEMVIEW_TRY_STATUS(check_pixels(request.camera.columns, request.camera.rows));
  return raycast::render_pinhole(*parts_->scene, request);
}

}  // namespace semview::service
