// SPDX-License-Identifier: Apache-2.0
// A kind of terminal that knows no more than to move, to clear and to write, so that a test can tell what its screen
// shows.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace test_support {

// The environment of a program that shall take its terminal for one of this kind.
inline std::map<std::string, std::string> plain_terminal(const Sandbox& sandbox) {
  const std::filesystem::path source = sandbox.directory() / "plain.ti";
  const std::filesystem::path compiled = sandbox.directory() / "terminfo";
  write_file(source,
             "plain|a terminal of a test, cols#80, lines#24, clear=\\E[H\\E[2J, cup=\\E[%i%p1%d;%p2%dH, ed=\\E[J, "
             "el=\\E[K,\n"
             "  kcud1=\\E[B, kcuu1=\\E[A, kend=\\E[F, khome=\\E[H,\n");
  const CommandResult result = run_command({"tic", "-o", compiled, source});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return {{"TERMINFO", compiled}, {"TERM", "plain"}};
}

}  // namespace test_support
