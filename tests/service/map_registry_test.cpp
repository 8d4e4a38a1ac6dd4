// SPDX-License-Identifier: Apache-2.0
#include "semview/service/map_registry.hpp"

#include <gtest/gtest.h>

#include "semview/service/site.hpp"
#include "service/small_map.hpp"
#include "support/engine_wish.hpp"

namespace semview::service {
namespace {

TEST(MapRegistryTest, FindsMapsByIdAndNamesThemWhenItCannot) {
  const testing::TemporaryFolder folder;
  MapRegistry registry;
  EXPECT_EQ(registry.find("a").error().code, ErrorCode::kNotFound);
  const auto site =
      *Site::open(testing::write_small_map(folder), {.engine = testing::engine_wish()});
  ASSERT_TRUE(registry.add(site).has_value());
  const auto found = registry.find("two_rooms");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(*found, site);
  const Error error = registry.find("three_rooms").error();
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_NE(error.message.find("two_rooms"), std::string::npos);
  EXPECT_EQ(registry.add(site).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(registry.sites().size(), 1U);
}

}  // namespace
}  // namespace semview::service
