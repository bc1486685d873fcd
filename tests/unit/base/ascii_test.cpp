// SPDX-License-Identifier: Apache-2.0
#include "base/text/ascii.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

TEST(Ascii, TrimsBlanksAtBothEnds) {
  EXPECT_EQ(trim(" \t one two\r\n"), "one two");
  EXPECT_EQ(trim("one"), "one");
  EXPECT_EQ(trim(" \n"), "");
  EXPECT_EQ(trim(""), "");
  EXPECT_EQ(trim("\vone ", " "), "\vone") << "only those that are given";
}

TEST(Ascii, LowersCapitalsOfAsciiAlone) {
  EXPECT_EQ(lower("Launch_42 ZA"), "launch_42 za");
  EXPECT_EQ(lower("\xC3\x84"), "\xC3\x84");
}

}  // namespace
}  // namespace launch
