// SPDX-License-Identifier: Apache-2.0
#include "semview/picture/box_plot.hpp"

#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semview/io/text_file.hpp"
#include "support/temporary_folder.hpp"

namespace semview::picture {
namespace {

using semview::testing::TemporaryFolder;
using ::testing::HasSubstr;

BoxPlot two_panels() {
  const PlotBox box{0.1, 0.2, 0.3, 0.4, 0.6, {0.9, 5.0}};
  BoxPlot plot;
  plot.title = "errors";
  plot.x_axis = "image";
  plot.y_axis = "m";
  plot.panels = {{"one", {{"ours", {0, 114, 178}, {box, box}}}, {{"odometry", {}, {0.1, 0.7}}}},
                 {"two", {{"ours", {0, 114, 178}, {box}}}, {}}};
  return plot;
}

TEST(BoxPlotTest, EqualPlotsMakeEqualFiles) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_box_plot_svg(folder / "one.svg", two_panels()));
  ASSERT_TRUE(write_box_plot_svg(folder / "two.svg", two_panels()));
  // Cairo numbers the surfaces of a process.
  const auto text = [&](const char* name) {
    return std::regex_replace(*io::read_text_file(folder / name, std::size_t{1} << 24U),
                              std::regex("surface[0-9]+"),
                              "surface");
  };
  EXPECT_EQ(text("one.svg"), text("two.svg"));
  EXPECT_THAT(text("one.svg"), HasSubstr("<svg"));
}

TEST(BoxPlotTest, PanelsThatAreComparedShareTheirScale) {
  const TemporaryFolder folder;
  BoxPlot plot = two_panels();
  plot.panels[0].curves[0].values = {0.1, 70.0};
  const auto drawn = [&](bool same_scale) {
    plot.same_scale = same_scale;
    EXPECT_TRUE(write_box_plot_svg(folder / "plot.svg", plot));
    return io::read_text_file(folder / "plot.svg", std::size_t{1} << 24U)->size();
  };
  // Its own scale would show the second panel's dots above 0.9 as far as they reach.
  EXPECT_NE(drawn(true), drawn(false));
}

TEST(BoxPlotTest, PanelsWithoutAnythingHaveAxes) {
  const TemporaryFolder folder;
  BoxPlot plot;
  plot.panels = {{"empty", {}, {}}};
  EXPECT_TRUE(write_box_plot_svg(folder / "empty.svg", plot));
}

TEST(BoxPlotTest, NothingToDrawIsAnError) {
  const Status status = write_box_plot_svg("unused.svg", {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace semview::picture
