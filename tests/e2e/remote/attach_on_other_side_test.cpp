// SPDX-License-Identifier: Apache-2.0
// `launch attach --on`: a terminal here, and that of a process on the other side of a connecting command.
#include <gmock/gmock.h>

#include "tests/e2e/remote/other_side.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

class AttachOnOtherSideTest : public OtherSide {
 protected:
  AttachOnOtherSideTest() {
    // It ends by the third Ctrl-C.
    write_launch_file(
        "<executable name=\"shell\" tty=\"true\" output=\"both\" sigterm_timeout=\"0\" cmd=\"python3 count.py\"/>");
    write_file(sandbox_.directory() / "count.py",
               "import os, signal, sys\n"
               "count = 0\n"
               "def interrupted(*_):\n"
               "    global count\n"
               "    count += 1\n"
               "    os.write(1, b'interrupted %d\\n' % count)\n"  // not by print(), in which the signal may come
               "    if count == 3:\n"
               "        sys.exit(7)\n"
               "signal.signal(signal.SIGINT, interrupted)\n"
               "print('ready', flush=True)\n"
               "for line in sys.stdin:\n"
               "    print('got', line.strip(), *os.get_terminal_size(), flush=True)\n");
  }

  std::vector<std::string> attach_to(const RunningCommand& run, const std::string& connect = "connect") const {
    std::vector<std::string> words = ask_of("attach", run, connect);
    words.emplace_back("shell");
    return words;
  }
};

TEST_F(AttachOnOtherSideTest, EachKeyIsForTheProcess) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[shell-1] ready", kPatience)) << run.out() << run.err();
  {
    Terminal terminal(attach_to(run), environment_);
    const tcflag_t before = terminal.local_modes();
    ASSERT_TRUE(terminal.shows("ready")) << terminal.everything();
    terminal.type("word\r");
    EXPECT_TRUE(terminal.shows("got word 80 24")) << terminal.everything();
    terminal.type("\003");
    EXPECT_TRUE(terminal.shows("interrupted 1")) << terminal.everything();
    terminal.type("\003");
    EXPECT_TRUE(terminal.shows("interrupted 2")) << terminal.everything();
    terminal.type("\020\021");
    EXPECT_EQ(terminal.wait(), 0) << terminal.everything();
    EXPECT_THAT(terminal.everything(), HasSubstr("launch attach: detached, shell-1 goes on\r\n"));
    EXPECT_EQ(terminal.local_modes(), before);
  }
  Terminal terminal(attach_to(run), environment_);
  ASSERT_TRUE(terminal.shows("interrupted 2")) << terminal.everything();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 7) << terminal.everything();
  EXPECT_EQ(run.wait().exit_code, 3) << "a process has failed";
  sandbox_.wait_until_daemons_are_left();
}

TEST_F(AttachOnOtherSideTest, WhatIsPipedInArrives) {
  write_launch_file(
      "<executable name=\"shell\" tty=\"true\" output=\"both\" shell=\"true\"\n"
      "cmd=\"stty raw -echo; echo ready; head -c 1000000 | wc -c; exit 5\"/>");
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[shell-1] ready", kPatience)) << run.out() << run.err();
  const Command attach{.argv = attach_to(run), .environment = environment_, .directory = sandbox_.directory()};
  const CommandResult result = run_command(attach, kPatience, std::string(1'000'000, 'x'));
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.out, "ready\n1000000\n");
  EXPECT_EQ(result.err, "launch attach: shell-1 has ended: exit code 5\n");
  EXPECT_EQ(run.wait().exit_code, 3) << "a process has failed";
  sandbox_.wait_until_daemons_are_left();
}

TEST_F(AttachOnOtherSideTest, TheKeysThatDetachEndAConnectionThatHangs) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[shell-1] ready", kPatience)) << run.out() << run.err();
  // Keys go through cat(1), which is stopped.
  write_script("hanging", "echo $$ > pid\nmkfifo in\n" + (sandbox_.directory() / "connect").string() +
                              " \"$*\" < in & exec cat > in");
  Terminal terminal(attach_to(run, "hanging"), environment_, sandbox_.directory());
  ASSERT_TRUE(terminal.shows("ready")) << terminal.everything();
  const pid_t other = std::stoi(read_file(sandbox_.directory() / "pid"));
  ::kill(other, SIGSTOP);
  terminal.type("\020\021");
  EXPECT_EQ(terminal.wait(), 255);
  EXPECT_THAT(terminal.everything(), HasSubstr("does not answer\r\n      = help: the process there goes on\r\n"));
  run.send_signal(SIGTERM);
  run.wait();
  sandbox_.wait_until_daemons_are_left();
}

}  // namespace
