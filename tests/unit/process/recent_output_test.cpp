// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/tty/recent_output.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

TEST(RecentOutput, GivesTheLastLines) {
  RecentOutput recent;
  EXPECT_EQ(recent.last_lines(24), "");
  recent.add("one\r\ntwo\r\nthr");
  recent.add("ee\r\n> ");
  EXPECT_EQ(recent.last_lines(24), "one\r\ntwo\r\nthree\r\n> ");
  EXPECT_EQ(recent.last_lines(2), "three\r\n> ");
  EXPECT_EQ(recent.last_lines(1), "> ");
  EXPECT_EQ(recent.last_lines(0), "");
  recent.add("\n");
  EXPECT_EQ(recent.last_lines(1), "> \n");
  recent.clear();
  EXPECT_EQ(recent.last_lines(24), "");
}

TEST(RecentOutput, KeepsABoundedPartWhichBeginsWithALine) {
  RecentOutput recent;
  const std::string line(99, 'x');
  for (int i = 0; i < 10'000; ++i) {
    recent.add(line + "\n");
  }
  const std::string_view kept = recent.last_lines(1'000'000);
  EXPECT_LE(kept.size(), 2 * RecentOutput::kMost);
  EXPECT_GE(kept.size(), RecentOutput::kMost - 100);
  EXPECT_EQ(kept.size() % 100, 0U);
  EXPECT_EQ(recent.last_lines(1), line + "\n");
}

TEST(RecentOutput, OfAHugePieceItKeepsTheEnd) {
  RecentOutput recent;
  recent.add("gone\n");
  recent.add(std::string(3 * RecentOutput::kMost, 'x') + "\nlast\n");
  EXPECT_EQ(recent.last_lines(24), "last\n");
  recent.add(std::string(3 * RecentOutput::kMost, 'y'));
  EXPECT_EQ(recent.last_lines(24), std::string(RecentOutput::kMost, 'y')) << "a line that is longer than all";
}

}  // namespace
}  // namespace launch
