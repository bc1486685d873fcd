// SPDX-License-Identifier: Apache-2.0
#include "launcher/base/command_error.hpp"

#include <gtest/gtest.h>

namespace launch {
namespace {

TEST(CommandError, IsTheCommandTheMessageAndItsHelp) {
  EXPECT_EQ(command_error("launch stop", "no launch runs"), "launch stop: error: no launch runs\n");
  EXPECT_EQ(command_error("launch top", "needs a terminal", "'launch ps' prints a table"),
            "launch top: error: needs a terminal\n"
            "      = help: 'launch ps' prints a table\n");
}

TEST(CommandError, OfAWrongCommandLinePointsToTheHelpOfTheCommand) {
  EXPECT_EQ(usage_error("launch logs", "--lines needs a number"),
            "launch logs: error: --lines needs a number\n"
            "      = help: see 'launch logs --help'\n");
}

TEST(CommandError, SuggestsOptionsAndCommands) {
  const KnownWords known{.options = {"-f", "--format"}, .commands = {"start", "stop"}};
  EXPECT_EQ(unexpected_word_error("launch trace", {"start", "--formt=json"}, known, "unexpected"),
            "launch trace: error: unknown option '--formt'\n"
            "      = help: did you mean '--format'?\n"
            "      = help: see 'launch trace --help'\n");
  EXPECT_EQ(unexpected_word_error("launch trace", {"-f", "strat"}, known, "unexpected"),
            "launch trace: error: unknown command 'strat'\n"
            "      = help: did you mean 'start'?\n"
            "      = help: see 'launch trace --help'\n");
  EXPECT_EQ(unexpected_word_error("launch trace", {"start"}, known, "unexpected"),
            "launch trace: error: unexpected\n"
            "      = help: see 'launch trace --help'\n");
}

}  // namespace
}  // namespace launch
