// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal_modes.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

TEST(TerminalModes, WhatAProgramHasChangedIsEnteredAndLeft) {
  TerminalModes modes;
  EXPECT_EQ(modes.entering(), "");
  EXPECT_EQ(modes.leaving(), "\033[0m");
  modes.add("text\033[?1049h\033[?1h\033=\033[?25l\033[1;31mred\033[2;20r");
  EXPECT_TRUE(modes.on_alternate_screen());
  EXPECT_EQ(modes.entering(), "\033[?1049h\033[?25l\033[?1h\033[2;20r\033=");
  EXPECT_EQ(modes.leaving(), "\0337\033[r\0338\033[?1l\033[?25h\033[?1049l\033>\033[0m");
  modes.add("\033[?1049l\033[?1l\033>\033[?25h\033[r");
  EXPECT_FALSE(modes.on_alternate_screen());
  EXPECT_EQ(modes.entering(), "");
  EXPECT_EQ(modes.leaving(), "\033[0m");
}

TEST(TerminalModes, ASequenceMayBeCutAnywhere) {
  TerminalModes modes;
  for (const char byte : std::string_view("a\033[?2004;1000hb")) {
    modes.add(std::string_view(&byte, 1));
  }
  EXPECT_EQ(modes.entering(), "\033[?2004h\033[?1000h");
}

TEST(TerminalModes, AResetForgetsAllAndNonsenseDoesNoHarm) {
  TerminalModes modes;
  modes.add("\033[?47h\033c");
  EXPECT_EQ(modes.entering(), "");
  modes.add("\033[?h\033[?x\033[?99999999999999999999h\033\033[\033[?;h\033[?5" + std::string(1000, '5') + "h");
  EXPECT_EQ(modes.entering(), "");
  modes.add("\033[?5h");
  EXPECT_EQ(modes.entering(), "\033[?5h");
  for (int mode = 100; mode < 1000; ++mode) {
    modes.add("\033[?" + std::to_string(mode) + "h");
  }
  EXPECT_LT(modes.entering().size(), 1000U);
}

}  // namespace
}  // namespace launch
