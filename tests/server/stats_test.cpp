// SPDX-License-Identifier: Apache-2.0
/// What GetStats tells of the view cache.
#include "semview/cache/lmdb_store.hpp"
#include "semview/cache/view_cache.hpp"
#include "semview/map/cell_grid.hpp"
#include "server/server_fixture.hpp"

namespace semview::test {
namespace {

class StatsTest : public ServerFixture {
 protected:
  /// Asks for the views of the first `count` free cells.
  void ask_for_views(RawClient& client, std::size_t count) const {
    v1::GetViewsRequest request;
    request.set_map_id("room");
    for (std::size_t i = 0; i < count; ++i) {
      const CellIndex cell = site_->cells().free_cells().at(i);
      request.mutable_cells()->add_ix(cell.ix);
      request.mutable_cells()->add_iy(cell.iy);
    }
    client.get<v1::GetViewsReply>("GetViews", request);
  }

  static v1::GetStatsReply stats(RawClient& client) {
    return client.get<v1::GetStatsReply>("GetStats", v1::GetStatsRequest());
  }
};

TEST_F(StatsTest, DamagedRecordsAndTheTiersOfTheCacheAreCounted) {
  service::SiteConfig config = small_sites();
  config.cache_directory = folder_.path() / "cache";
  restart_with(config);
  const CellIndex cell = site_->cells().free_cells().front();
  const auto view = site_->engine_views().views(std::vector{cell})->views.front();
  cache::EncodedView damaged =
      cache::LmdbStore::encode(cache::digest(site_->keyspace()), cell, *view);
  damaged.record.back() ^= std::byte{0x10};
  ASSERT_TRUE(site_->tiers().store->put_encoded(site_->keyspace(), std::vector{damaged}));

  RawClient client(server_->endpoint());
  ask_for_views(client, 2);
  ask_for_views(client, 2);
  const v1::GetStatsReply reply = stats(client);
  EXPECT_EQ(reply.disk().damaged(), 1U);
  EXPECT_EQ(reply.disk().foreign() + reply.disk().unknown(), 0U);
  EXPECT_EQ(reply.disk().misses(), 2U);
  EXPECT_EQ(reply.disk().stored(), 3U) << "the damaged one and two that were cast";
  EXPECT_GT(reply.disk().bytes(), 0U);
  EXPECT_TRUE(reply.disk().storing());
  EXPECT_EQ(reply.memory().stored(), 2U);
  EXPECT_EQ(reply.memory().hits(), 2U);
  EXPECT_EQ(reply.views_cast(), 2U);
  EXPECT_EQ(reply.views_awaited(), 0U);
}

TEST_F(StatsTest, ACacheThatHasStoppedStoringSaysSo) {
  service::SiteConfig config = small_sites();
  config.cache_directory = folder_.path() / "cache";
  config.cache_limit_bytes = 1;
  restart_with(config);
  RawClient client(server_->endpoint());
  ask_for_views(client, 5);
  EXPECT_FALSE(stats(client).disk().storing());
  EXPECT_EQ(stats(client).disk().refused(), 5U);
}

TEST_F(StatsTest, ViewsDroppedFromMemoryAreCountedAndWithoutADirectoryThereIsNoDisk) {
  service::SiteConfig config = small_sites();
  config.memory_bytes = 10'000;
  restart_with(config);
  RawClient client(server_->endpoint());
  ask_for_views(client, 100);
  const v1::GetStatsReply reply = stats(client);
  EXPECT_FALSE(reply.has_disk());
  EXPECT_GT(reply.memory().evicted(), 0U);
  EXPECT_LE(reply.memory().bytes(), 10'000U);
}

TEST_F(StatsTest, MethodsTellHowLongTheirRequestsTook) {
  start({}, clock_);
  RawClient client(server_->endpoint());
  ask_for_views(client, 1);
  // Three quick ones so far, and one that waits for a view while time passes.
  ask_for_views(client, 1);
  ask_for_views(client, 1);
  HeldView held(*site_, kQuietCell);
  const auto waits = site_->tiers().cache->counters().waits;
  client.send(RawClient::header("GetViews"), view_request(kQuietCell).SerializeAsString());
  ASSERT_TRUE(eventually([&] { return site_->tiers().cache->counters().waits > waits; }));
  clock_.advance(std::chrono::milliseconds(700));
  held.release();
  ASSERT_TRUE(client.receive());
  const v1::GetStatsReply reply = stats(client);
  ASSERT_TRUE(reply.latency_by_method().contains("GetViews"));
  const v1::MethodLatency& views = reply.latency_by_method().at("GetViews");
  EXPECT_EQ(views.count(), 4U);
  EXPECT_EQ(views.p50_ms(), 0.001) << "the shortest that is told";
  EXPECT_EQ(views.p99_ms(), 700.0);
  EXPECT_EQ(views.max_ms(), 700.0);
  EXPECT_FALSE(reply.latency_by_method().contains("Score"));
}

TEST_F(StatsTest, ViewsThatWereAwaitedAreCounted) {
  RawClient client(server_->endpoint());
  HeldView held(*site_, kQuietCell);
  client.send(RawClient::header("GetViews"), view_request(kQuietCell).SerializeAsString());
  ASSERT_TRUE(eventually([this] { return site_->tiers().cache->counters().waits > 0; }));
  held.release();
  ASSERT_TRUE(client.receive());
  EXPECT_EQ(stats(client).views_awaited(), 1U);
}

}  // namespace
}  // namespace semview::test
