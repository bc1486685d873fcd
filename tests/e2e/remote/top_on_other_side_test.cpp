// SPDX-License-Identifier: Apache-2.0
// `launch top --on`: a terminal here, the command on the other side of a connecting command.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/e2e/remote/other_side.hpp"

namespace {

using namespace test_support;

class TopOnOtherSideTest : public OtherSide {
 protected:
  TopOnOtherSideTest() {
    write_launch_file(
        "<executable name=\"sleeper\" cmd=\"sleep 1000\"/>\n<executable name=\"talker\" shell=\"true\" "
        "output=\"both\" cmd=\"echo ready; while :; do read x; done\"/>");
  }

  std::vector<std::string> top_of(const RunningCommand& run, const std::string& connect = "connect") const {
    return ask_of("top", run, connect);
  }
};

TEST_F(TopOnOtherSideTest, KeysAndSizesArriveAndTheScreenComesBack) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[talker-2] ready", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  top.type("x");
  EXPECT_TRUE(top.shows("sleeper-1", "ended: SIGINT")) << top.screen();
  top.type("s");
  EXPECT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  top.resize(40, 120);
  EXPECT_TRUE(top.shows("quit", "s start  x stop  r restart  k signal  l log  t nodes  / filter  o sort  q quit"))
      << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  end(run);
}

TEST_F(TopOnOtherSideTest, ControlCEndsBothSidesAndSetsTheTerminalBack) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[talker-2] ready", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run), environment_);
  const tcflag_t before = top.local_modes();
  ASSERT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  EXPECT_EQ(top.local_modes() & (ICANON | ECHO | ISIG), 0U);
  top.type("\003");
  EXPECT_NE(top.wait(), 0);
  EXPECT_EQ(before & (ICANON | ECHO | ISIG), tcflag_t{ICANON | ECHO | ISIG});
  end(run);
}

// The whole foreground group gets the signal: the connecting command, too, whose end may be seen first.
TEST_F(TopOnOtherSideTest, ControlCEndsACommandWithoutATerminalThere) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[talker-2] ready", kPatience)) << run.out() << run.err();
  write_script("dying", "mkfifo in; " + (sandbox_.directory() / "connect").string() +
                            " \"$*\" < in & exec cat > in");  // cat(1) ends by the signal
  for (const char* const connect : {"connect", "dying"}) {
    Terminal logs(
        {LAUNCH_PROGRAM, "logs", "-f", "--launch", std::to_string(run.pid()), "--on", sandbox_.directory() / connect},
        environment_, sandbox_.directory());
    ASSERT_TRUE(logs.shows("[talker-2] ready")) << logs.everything();
    logs.type("\003");
    EXPECT_EQ(logs.wait(), -1) << "it ends by the signal";
    EXPECT_THAT(logs.everything(), testing::Not(testing::HasSubstr("error")));
  }
  end(run);
}

TEST_F(TopOnOtherSideTest, AConnectionThatMakesATerminalItselfWorksAsWell) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[talker-2] ready", kPatience)) << run.out() << run.err();
  // As `ssh -t`.
  write_script("terminal", "exec script -qfec \"" + (sandbox_.directory() / "connect").string() + " $*\" /dev/null");
  Terminal top(top_of(run, "terminal"), environment_);
  ASSERT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  end(run);
}

TEST_F(TopOnOtherSideTest, AConnectionThatDiesIsTold) {
  RunningCommand run(launch());
  ASSERT_TRUE(run.wait_for_output("[talker-2] ready", kPatience)) << run.out() << run.err();
  write_script("dying", "echo $$ > pid\nexec " + (sandbox_.directory() / "connect").string() + " \"$*\"");
  Terminal top(top_of(run, "dying"), environment_, sandbox_.directory());
  ASSERT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  ::kill(std::stoi(read_file(sandbox_.directory() / "pid")), SIGKILL);
  EXPECT_EQ(top.wait(), 255);
  EXPECT_THAT(top.everything(), testing::HasSubstr("launch top: error: the connection has ended: '"));
  EXPECT_THAT(top.everything(), testing::HasSubstr("was ended by SIGKILL"));
  end(run);
}

}  // namespace
