// SPDX-License-Identifier: Apache-2.0
#include "base/terminal/terminal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>

#include "base/files/pipe.hpp"
#include "base/files/unique_fd.hpp"

namespace launch {
namespace {

class TerminalTest : public testing::Test {
 protected:
  TerminalTest() {
    ::grantpt(other_side_.get());
    ::unlockpt(other_side_.get());
    terminal_.reset(::open(::ptsname(other_side_.get()), O_RDWR | O_NOCTTY | O_CLOEXEC));
    ::setenv("TERM", "xterm", 1);
    ::unsetenv("NO_COLOR");
    ::unsetenv("RCUTILS_COLORIZED_OUTPUT");
  }

  int terminal() const { return terminal_.get(); }
  int pipe() const { return pipe_.write.get(); }

 private:
  UniqueFd other_side_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  UniqueFd terminal_;
  Pipe pipe_ = make_pipe();
};

TEST_F(TerminalTest, ShowsColoursAndAPipeDoesNot) {
  EXPECT_TRUE(shows_colour(terminal()));
  EXPECT_FALSE(shows_colour(pipe()));
}

TEST_F(TerminalTest, ThatIsDumbOrUnknownTakesNoControlSequences) {
  EXPECT_TRUE(takes_control_sequences(terminal()));
  ::setenv("TERM", "dumb", 1);
  EXPECT_FALSE(takes_control_sequences(terminal()));
  EXPECT_FALSE(shows_colour(terminal()));
  ::unsetenv("TERM");
  EXPECT_FALSE(takes_control_sequences(terminal()));
  EXPECT_FALSE(shows_colour(terminal()));
}

TEST_F(TerminalTest, ShowsNoColoursWithNoColorThatIsNotEmpty) {
  ::setenv("NO_COLOR", "", 1);
  EXPECT_TRUE(shows_colour(terminal()));
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(shows_colour(terminal()));
  EXPECT_TRUE(takes_control_sequences(terminal()));
}

TEST_F(TerminalTest, FollowsTheVariableOfTheNodesFirst) {
  ::setenv("RCUTILS_COLORIZED_OUTPUT", "0", 1);
  EXPECT_FALSE(shows_colour(terminal()));
  ::setenv("RCUTILS_COLORIZED_OUTPUT", "1", 1);
  ::setenv("NO_COLOR", "1", 1);
  ::setenv("TERM", "dumb", 1);
  EXPECT_TRUE(shows_colour(terminal()));
  EXPECT_TRUE(shows_colour(pipe()));
}

TEST_F(TerminalTest, HasEightyColumnsUnlessItTells) {
  EXPECT_EQ(terminal_columns(pipe()), 80U);
  EXPECT_EQ(terminal_size(pipe()).columns, 0U);
  const winsize size{24, 132, 0, 0};
  ASSERT_EQ(::ioctl(terminal(), TIOCSWINSZ, &size), 0);
  EXPECT_EQ(terminal_columns(terminal()), 132U);
  EXPECT_EQ(terminal_size(terminal()).lines, 24U);
}

}  // namespace
}  // namespace launch
