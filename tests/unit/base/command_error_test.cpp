// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/command_error.hpp"

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

TEST(CommandError, SuggestsValues) {
  EXPECT_EQ(wrong_value_error("launch graph", "--format: svgz not in {dot,svg}"),
            "launch graph: error: --format svgz is unknown, expected dot, svg\n"
            "      = help: did you mean 'svg'?\n"
            "      = help: see 'launch graph --help'\n");
  EXPECT_EQ(wrong_value_error("launch graph", "--format: html not in {dot,svg}"),
            "launch graph: error: --format html is unknown, expected dot, svg\n"
            "      = help: see 'launch graph --help'\n");
  EXPECT_EQ(wrong_value_error("launch report", "directory is required"),
            "launch report: error: directory is required\n"
            "      = help: see 'launch report --help'\n");
}

}  // namespace
}  // namespace launch
