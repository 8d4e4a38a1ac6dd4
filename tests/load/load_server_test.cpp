// SPDX-License-Identifier: Apache-2.0
/// Simulated robots against a real server.
#include "client/client_fixture.hpp"
#include "client/lib/remote_view_source.hpp"
#include "client/load/dealer_wire.hpp"
#include "client/load/kernel_time.hpp"
#include "client/load/load_work.hpp"
#include "semview/map/cell_grid.hpp"

namespace semview::test {
namespace {

using client::DealerWire;
using client::LoadConfig;
using client::LoadKind;
using client::LoadWork;

class LoadServerTest : public ClientFixture {
 protected:
  Result<client::LoadReport> run(const LoadConfig& load, LoadKind kind) const {
    SEMVIEW_TRY(const LoadWork work, LoadWork::prepare(config(), "room", kind));
    SEMVIEW_TRY(const auto wire, DealerWire::open(endpoint_, load.robots));
    return run_open_loop(load, work, *wire, steady_clock());
  }
};

TEST_F(LoadServerTest, AFewRobotsAreAllAnswered) {
  LoadConfig load;
  load.robots = 3;
  load.seconds = 0.5;
  load.timeout = std::chrono::seconds(20);
  load.in_time = load.timeout;
  for (const LoadKind kind : {LoadKind::kGlobal, LoadKind::kTracking}) {
    const auto report = run(load, kind);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->cycles, 3U);
    EXPECT_EQ(report->answered, 3U);
    EXPECT_GT(report->p50_ms, 0.0);
  }
  EXPECT_EQ(server_->counters().errors, 0U);
}

TEST_F(LoadServerTest, ServersThatAreGoneCostTheTimeLimitAndNoMore) {
  LoadConfig load;
  load.robots = 2;
  load.seconds = 0.5;
  load.timeout = std::chrono::milliseconds(200);
  const auto work = LoadWork::prepare(config(), "room", LoadKind::kTracking);
  ASSERT_TRUE(work);
  stop();
  const auto wire = DealerWire::open(endpoint_, load.robots);
  const auto report = run_open_loop(load, *work, **wire, steady_clock());
  EXPECT_EQ(report->timed_out, report->cycles);
}

TEST_F(LoadServerTest, GlobalPosesStandInDistinctFreeCellsAndTrackingOnesAroundTheRobot) {
  const auto global = LoadWork::prepare(config(), "room", LoadKind::kGlobal);
  ASSERT_TRUE(global) << global.error().message;
  const std::size_t free_cells = site_->cells().free_cells().size();
  EXPECT_EQ(global->places().front().request.poses.size(),
            std::min(free_cells, client::kGlobalCells));
  EXPECT_EQ(global->cells().size(), std::min(free_cells, client::kGlobalCells));
  const auto tracking = LoadWork::prepare(config(), "room", LoadKind::kTracking);
  EXPECT_EQ(tracking->places().front().request.poses.size(), client::kTrackingPoses);
  EXPECT_EQ(tracking->places().front().request.mode, HeadingMode::kAsGiven);
}

TEST_F(LoadServerTest, TheKernelTimeIsThatOfPreparingAndScoring) {
  const auto work = LoadWork::prepare(config(), "room", LoadKind::kTracking);
  const auto time = client::kernel_time(*work, site_->views());
  ASSERT_TRUE(time) << time.error().message;
  EXPECT_GT(time->prepare_ms, 0.0);
  EXPECT_GT(time->score_ms, 0.0);
  EXPECT_DOUBLE_EQ((client::KernelTime{1.0, 4.0}.robots(2, 2.0)), 200.0);
}

TEST(DealerWireTest, OnlyThisMachineIsLoaded) {
  using client::check_is_this_machine;
  for (const char* own :
       {"tcp://127.0.0.1:5560", "tcp://localhost:1", "tcp://127.1.2.3:5560", "tcp://[::1]:5560"}) {
    EXPECT_TRUE(check_is_this_machine(own)) << own;
  }
  for (const char* other : {"tcp://192.0.2.1:5560",
                            "tcp://example.org:5560",
                            "tcp://127.0.0.1.example.org:5560",
                            "tcp://127.evil.example:5560",
                            "tcp://[2001:db8::1]:5560",
                            "ipc:///tmp/x",
                            ""}) {
    EXPECT_EQ(check_is_this_machine(other).error().field, "--server") << other;
  }
}

}  // namespace
}  // namespace semview::test
