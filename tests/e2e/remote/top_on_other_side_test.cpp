// SPDX-License-Identifier: Apache-2.0
// `launch top --on`: a terminal here, the command on the other side of a connecting command.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/support/plain_terminal.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/terminal.hpp"

namespace {

using namespace test_support;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};

class TopOnOtherSideTest : public testing::Test {
 protected:
  TopOnOtherSideTest() {
    fs::create_directory(sandbox_.directory() / "run");
    environment_ = plain_terminal(sandbox_);
    environment_["XDG_RUNTIME_DIR"] = sandbox_.directory() / "run";
    // As ssh: words are joined, a shell reads them, and little of the environment arrives.
    write_script("connect", "exec env -i TERMINFO=\"$TERMINFO\" XDG_RUNTIME_DIR=\"$XDG_RUNTIME_DIR\" PATH=" +
                                fs::path(LAUNCH_PROGRAM).parent_path().string() + ":/usr/bin:/bin sh -c \"$*\"");
    write_file(
        sandbox_.directory() / "system.launch.xml",
        "<launch>\n<executable name=\"sleeper\" cmd=\"sleep 1000\"/>\n<executable name=\"talker\" shell=\"true\" "
        "output=\"both\" cmd=\"echo ready; while :; do read x; done\"/>\n</launch>\n");
  }

  void write_script(const std::string& name, const std::string& text) const {
    write_file(sandbox_.directory() / name, "#!/bin/sh\n" + text + "\n");
    fs::permissions(sandbox_.directory() / name, fs::perms::owner_all);
  }
  Command launch() const {
    return {.argv = {LAUNCH_PROGRAM, (sandbox_.directory() / "system.launch.xml").string()},
            .environment = environment_,
            .directory = sandbox_.directory()};
  }
  // The other side's command ends by itself, which may take longer than the end of the connection.
  void end(RunningCommand& run) {
    run.send_signal(SIGINT);
    EXPECT_EQ(run.wait().exit_code, 0);
    sandbox_.wait_until_daemons_are_left();
  }
  std::vector<std::string> top_of(const RunningCommand& run, const std::string& connect = "connect") const {
    return {LAUNCH_PROGRAM, "top", "--launch", std::to_string(run.pid()), "--on", sandbox_.directory() / connect};
  }

  Sandbox sandbox_;
  std::map<std::string, std::string> environment_;
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
