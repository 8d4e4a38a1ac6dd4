// SPDX-License-Identifier: Apache-2.0
/// Work that takes as long as a test wants.
#pragma once

#include <future>
#include <span>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "semview/cache/view_cache.hpp"
#include "semview/service/site.hpp"

namespace semview::test {

/// Makes the view of a cell, and is not done before it is released: whoever asks the site for that
/// view meanwhile waits. Nobody may have asked for it before.
class HeldView {
 public:
  HeldView(const service::Site& site, const CellIndex& cell)
      : maker_([this, &site, cell] {
          const auto made = site.tiers().cache->get_or_compute(
              site.keyspace(), std::vector{cell}, [&](std::span<const CellIndex> cells) {
                held_.set_value();
                released_.get_future().wait();
                return Result<std::vector<SharedView>>(site.engine_views().views(cells)->views);
              });
          EXPECT_TRUE(made);
        }) {
    held_.get_future().wait();
  }
  ~HeldView() { release(); }
  HeldView(const HeldView&) = delete;
  HeldView& operator=(const HeldView&) = delete;

  void release() {
    if (!maker_.joinable()) return;
    released_.set_value();
    maker_.join();
  }

 private:
  std::promise<void> held_;
  std::promise<void> released_;
  std::thread maker_;
};

}  // namespace semview::test
