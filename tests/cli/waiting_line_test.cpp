// SPDX-License-Identifier: Apache-2.0
// How far long work is: nothing for what is soon over, then lines with what is left.
#include "cli/waiting_line.hpp"

#include <gtest/gtest.h>

namespace semview::cli {
namespace {

using std::chrono::seconds;

TEST(WaitingLineTest, SaysNothingOfWorkThatIsSoonOver) {
  ManualClock clock;
  WaitingLine line("a hint", true, clock);
  EXPECT_EQ(line.text(1, 2, "cells"), "");
  clock.advance(seconds(1));
  EXPECT_EQ(line.text(2, 2, "cells"), "");
}

TEST(WaitingLineTest, AfterTwoSecondsGivesTheHintOnceAndWhatIsLeft) {
  ManualClock clock;
  WaitingLine line("a hint", false, clock);
  EXPECT_EQ(line.text(0, 100, "cells"), "");
  clock.advance(seconds(4));
  EXPECT_EQ(line.text(10, 100, "cells"), "a hint\n10 of 100 cells, about 36 s left\n");
  clock.advance(seconds(1));
  EXPECT_EQ(line.text(20, 100, "cells"), "") << "elsewhere than on a terminal: every 5 s";
  clock.advance(seconds(5));
  EXPECT_EQ(line.text(100, 100, "cells"), "100 of 100 cells\n");
}

TEST(WaitingLineTest, OnATerminalTheLineIsWrittenOverAndEnds) {
  ManualClock clock;
  WaitingLine line("", true, clock);
  clock.advance(seconds(3));
  EXPECT_EQ(line.text(0, 4, "drives"), "\r\x1b[K0 of 4 drives");
  EXPECT_EQ(line.text(4, 4, "drives"), "\r\x1b[K4 of 4 drives\n");
}

TEST(WaitingLineTest, OtherWorkIsTimedFromItsOwnBeginning) {
  ManualClock clock;
  WaitingLine line("", false, clock);
  EXPECT_EQ(line.text(0, 10, "cells"), "");
  clock.advance(seconds(60));
  EXPECT_EQ(line.text(0, 10, "places"), "0 of 10 places\n");
  clock.advance(seconds(5));
  EXPECT_EQ(line.text(5, 10, "places"), "5 of 10 places, about 5 s left\n");
}

}  // namespace
}  // namespace semview::cli
