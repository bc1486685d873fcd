// SPDX-License-Identifier: Apache-2.0
// launch attach: a terminal here, and that of a process of a running launch.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include "tests/e2e/command_line/control_fixture.hpp"
#include "tests/support/terminal.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;

// Its prompts are "<1>", "<2>" and so on. What is typed before the first one may be lost.
const std::string kShell = R"xml(<executable name="shell" cmd="bash --norc --noprofile" tty="true" output="both"
    sigterm_timeout="0"><env name="PS1" value="&lt;\\#&gt; "/><env name="TERM" value="dumb"/></executable>)xml";

constexpr tcflag_t kUsualModes = ICANON | ECHO | ISIG;

class AttachTest : public Control {
 protected:
  AttachTest() { environment_["TERM"] = "xterm"; }

  std::vector<std::string> attach(const RunningCommand& run, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {LAUNCH_PROGRAM, "attach", "shell", "--launch", std::to_string(run.pid())});
    return options;
  }
  void end(RunningCommand& run) const {
    run.send_signal(SIGINT);
    const CommandResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  }
};

TEST_F(AttachTest, KeysAndSizesArriveAndTheProcessGoesOn) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  {
    Terminal terminal(attach(run), environment_);
    const tcflag_t before = terminal.local_modes();
    ASSERT_TRUE(terminal.shows("launch attach: shell-1; ctrl-p ctrl-q detaches")) << terminal.everything();
    ASSERT_TRUE(terminal.shows("<1>")) << terminal.everything();
    EXPECT_EQ(terminal.local_modes() & kUsualModes, 0U);
    terminal.type("stty size; tty\r");
    ASSERT_TRUE(terminal.shows_line("24 80")) << terminal.screen();
    ASSERT_TRUE(terminal.shows("/dev/pts/")) << terminal.screen();
    ASSERT_TRUE(terminal.shows("<2>")) << terminal.screen();
    terminal.resize(40, 120);
    terminal.type("while [ \"$(stty size)\" != '40 120' ]; do :; done; echo re\"\"sized\r");
    ASSERT_TRUE(terminal.shows_line("resized")) << terminal.screen();
    // What prints is what Ctrl-C ends: between two commands the shell would take it.
    terminal.type("sh -c 'echo wai\"\"ting; exec cat'\r");
    ASSERT_TRUE(terminal.shows_line("waiting")) << terminal.screen();
    terminal.type("\003");
    ASSERT_TRUE(terminal.shows("<4>")) << terminal.screen();
    terminal.type("echo inter\"\"rupted\r");
    ASSERT_TRUE(terminal.shows_line("interrupted")) << terminal.screen();
    ASSERT_TRUE(terminal.shows("<5>")) << terminal.screen();
    terminal.type("\020\021");  // Ctrl-P Ctrl-Q
    EXPECT_EQ(terminal.wait(), 0) << terminal.everything();
    EXPECT_THAT(terminal.everything(), HasSubstr("\r\nlaunch attach: detached, shell-1 goes on\r\n"));
    EXPECT_EQ(terminal.local_modes(), before);
  }
  ASSERT_TRUE(run.wait_for_output("[shell-1] interrupted", kPatience)) << "the screen of the launch has it, too";
  Terminal again(attach(run), environment_);
  ASSERT_TRUE(again.shows_line("interrupted")) << "what was printed before:\n" << again.screen();
  again.type("exit 3\r");
  EXPECT_EQ(again.wait(), 3);
  EXPECT_THAT(again.everything(), HasSubstr("launch attach: shell-1 has ended: exit code 3\r\n"));
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 3) << "a process has failed";
}

TEST_F(AttachTest, ALaunchThatIsKilledSetsTheTerminalBack) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  Terminal terminal(attach(run), environment_);
  const tcflag_t before = terminal.local_modes();
  ASSERT_TRUE(terminal.shows("<1>")) << terminal.everything();
  ::kill(launcher_below(run.pid()), SIGKILL);
  EXPECT_EQ(terminal.wait(), 1);
  EXPECT_THAT(terminal.everything(),
              HasSubstr("launch attach: error: launch " + std::to_string(run.pid()) + " has ended\r\n"));
  EXPECT_EQ(terminal.local_modes(), before);
  run.wait();
}

TEST_F(AttachTest, SignalsEndItAndNotTheProcess) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    Terminal terminal(attach(run), environment_);
    const tcflag_t before = terminal.local_modes();
    ASSERT_TRUE(terminal.shows("<1>")) << terminal.everything();
    ::kill(terminal.pid(), signal);
    EXPECT_EQ(terminal.wait(), -1) << "it ends by the signal";
    EXPECT_EQ(terminal.local_modes(), before);
  }
  {
    Terminal window(attach(run), environment_);
    ASSERT_TRUE(window.shows("<1>")) << window.everything();
    EXPECT_NE(window.close(), 0);
  }
  EXPECT_EQ(ps()["launches"][0]["processes"][0]["state"], "running");
  EXPECT_EQ(ps()["launches"][0]["processes"][0]["tty"], true);
  end(run);
}

TEST_F(AttachTest, SeveralSeeAndTypeAtTheSameTime) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  Terminal one(attach(run), environment_);
  ASSERT_TRUE(one.shows("<1>")) << one.everything();
  Terminal two(attach(run), environment_);
  ASSERT_TRUE(two.shows("launch attach: shell-1, one other is attached as well; ctrl-p ctrl-q detaches"))
      << two.everything();
  ASSERT_TRUE(two.shows("<1>")) << two.everything();
  two.type("echo of\"\"two\r");
  EXPECT_TRUE(one.shows_line("oftwo")) << one.screen();
  EXPECT_TRUE(two.shows_line("oftwo")) << two.screen();
  one.type("echo of\"\"one\r");
  EXPECT_TRUE(two.shows_line("ofone")) << two.screen();
  EXPECT_TRUE(one.shows_line("ofone")) << one.screen();
  two.type("\020\021");
  EXPECT_EQ(two.wait(), 0);
  one.type("exit\r");
  EXPECT_EQ(one.wait(), 0);
  end(run);
}

// It reads nothing while the process prints 50 MB. Neither the process nor the launch waits for it.
TEST_F(AttachTest, AStoppedClientHoldsNothingUp) {
  RunningCommand run(launch({write(R"xml(<executable name="shell" tty="true" stdout="none" shell="true"
    cmd="echo ready; read x; yes a line of fifty bytes, of which there are many | head -c 50000000; echo; echo the last line"/>
<executable name="sleeper" cmd="sleep 1000"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  Terminal stopped(attach(run), environment_);
  ASSERT_TRUE(stopped.shows("ready")) << stopped.everything();
  ::kill(stopped.pid(), SIGSTOP);
  const CommandResult other = run_command(launch({"attach", "shell"}), kPatience, "go\n");
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_THAT(other.out, HasSubstr("the last line\r\n"));
  EXPECT_EQ(ps()["launches"][0]["processes"][0]["state"], "ended");
  ::kill(stopped.pid(), SIGCONT);
  EXPECT_EQ(stopped.wait(), 0);
  EXPECT_THAT(stopped.everything(), HasSubstr(" bytes came too fast and are left out]\r\n"));
  EXPECT_THAT(stopped.everything(), HasSubstr("the last line\r\n"));
  EXPECT_THAT(stopped.everything(), HasSubstr("launch attach: shell-1 has ended: exit code 0"));
  end(run);
}

TEST_F(AttachTest, TheEndOfTheLaunchWaitsForAClientThatReads) {
  RunningCommand run(launch({write(R"xml(<executable name="shell" tty="true" stdout="none" shell="true"
    cmd="echo ready; read x; yes a line of fifty bytes, of which there are many | head -c 900000; echo; echo the last line"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  const CommandResult result = run_command(launch({"attach", "shell"}), kPatience, "go\n");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the last line\r\n"));
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(AttachTest, WithoutATerminalItIsAPlainStream) {
  RunningCommand run(launch({write(R"xml(<executable name="shell" tty="true" output="both" shell="true"
    cmd="stty raw -echo; echo ready; head -c 300000 | wc -c; exit 5"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[shell-1] ready", kPatience)) << run.out() << run.err();
  const CommandResult result = run_command(launch({"attach", "shell"}), kPatience, std::string(300'000, 'x'));
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_EQ(result.out, "ready\n300000\n");
  EXPECT_EQ(result.err, "launch attach: shell-1 has ended: exit code 5\n");
  EXPECT_EQ(run.wait().exit_code, 3) << "a process has failed";
}

TEST_F(AttachTest, WithoutStandardInputItOnlyShows) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  Terminal viewer(attach(run, {"--no-stdin"}), environment_);
  const tcflag_t before = viewer.local_modes();
  ASSERT_TRUE(viewer.shows("launch attach: shell-1; ctrl-c or ctrl-p ctrl-q detaches")) << viewer.everything();
  ASSERT_TRUE(viewer.shows("<1>")) << viewer.everything();
  viewer.resize(50, 150);
  viewer.type("echo of\"\"viewer\r");
  Terminal terminal(attach(run, {"--detach-keys", "ctrl-a,d"}), environment_);
  ASSERT_TRUE(terminal.shows("<1>")) << terminal.everything();
  terminal.type("stty size\r");
  EXPECT_TRUE(viewer.shows_line("24 80")) << viewer.screen();
  viewer.type("\003");
  EXPECT_EQ(viewer.wait(), -1) << "it ends by SIGINT";
  EXPECT_EQ(viewer.local_modes(), before);
  EXPECT_THAT(viewer.everything(), Not(HasSubstr("ofviewer")));
  terminal.type("\001d");
  EXPECT_EQ(terminal.wait(), 0);
  end(run);
}

TEST_F(AttachTest, AProgramOnTheWholeScreenDrawsAgainAndTheScreenIsSetBack) {
  write_file(sandbox_.directory() / "screen.py",
             "import os, signal\n"
             // Not print(), which may be in the middle of its text when the signal comes.
             "signal.signal(signal.SIGWINCH, lambda *_: os.write(1, b'drawn\\n'))\n"
             "print('\\033[?1049h\\033[?25lready', flush=True)\n"
             "while True:\n"
             "    signal.pause()\n");
  RunningCommand run(
      launch({write(R"xml(<executable name="shell" tty="true" output="both" cmd="python3 screen.py"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("ready", kPatience)) << run.out() << run.err();
  for (int time = 0; time < 2; ++time) {
    Terminal terminal(attach(run), environment_);
    ASSERT_TRUE(terminal.shows("drawn")) << terminal.everything();
    EXPECT_THAT(terminal.everything(), HasSubstr("\033[?1049h"));
    terminal.type("\020\021");
    EXPECT_EQ(terminal.wait(), 0);
    EXPECT_THAT(terminal.everything(), HasSubstr("\033[?25h\033[?1049l\033[0m"));
  }
  run.send_signal(SIGINT);
  run.wait();
}

TEST_F(AttachTest, TheEndOfARunEndsItAlsoIfTheProcessStartsAgain) {
  RunningCommand run(
      launch({write(R"xml(<executable name="shell" cmd="cat" tty="true" respawn="true" respawn_delay="1000"/>)xml")}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  {
    Terminal terminal(attach(run), environment_);
    ASSERT_TRUE(terminal.shows("launch attach: shell-1; ctrl-p")) << terminal.everything();
    terminal.type("\004");  // the end of what cat reads
    EXPECT_EQ(terminal.wait(), 0);
    EXPECT_THAT(terminal.everything(), HasSubstr("launch attach: shell-1 has ended: exit code 0; it starts again\r\n"));
  }
  EXPECT_EQ(ask({"attach", "shell"}).err,
            "launch attach: error: 'shell-1' does not run\n      = help: it starts again by itself\n");
  EXPECT_EQ(ask({"start", "shell"}).exit_code, 0);
  Terminal terminal(attach(run), environment_);
  ASSERT_TRUE(terminal.shows("launch attach: shell-1; ctrl-p")) << terminal.everything();
  EXPECT_EQ(ask({"restart", "shell"}).exit_code, 0);
  EXPECT_EQ(terminal.wait(), 128 + SIGINT);
  EXPECT_THAT(terminal.everything(), HasSubstr("launch attach: shell-1 has ended: SIGINT; it starts again\r\n"));
  run.send_signal(SIGINT);
  run.wait();
}

TEST_F(AttachTest, ATerminalIsNotAttachedToItself) {
  RunningCommand run(launch({write(kShell)}));
  ASSERT_TRUE(run.wait_for_output("[shell-1]: process started", kPatience)) << run.out() << run.err();
  Terminal terminal(attach(run), environment_);
  ASSERT_TRUE(terminal.shows("<1>")) << terminal.everything();
  terminal.type(std::string(LAUNCH_PROGRAM) + " attach shell\r");
  EXPECT_TRUE(terminal.shows("launch attach: error: this terminal is that of 'shell-1'")) << terminal.screen();
  end(run);
}

TEST_F(AttachTest, WhatCannotBeAttachedIsTold) {
  EXPECT_EQ(ask({"attach"}).err, "launch attach: error: NAME is required\n      = help: see 'launch attach --help'\n");
  EXPECT_EQ(ask({"attach", "shell", "--detach-keys", "ctrl-p,space"}).err,
            "launch attach: error: --detach-keys: 'ctrl-p,space' names no keys\n"
            "      = help: write keys with commas between, such as ctrl-a,d\n"
            "      = help: see 'launch attach --help'\n");
  EXPECT_EQ(ask({"attach", "shell"}).err, "launch attach: error: no launch runs\n");
  const std::string file = write(R"xml(<executable name="sleeper" cmd="sleep 1000"/>
<executable name="one" cmd="cat" tty="true"/>
<executable name="two" cmd="cat" tty="true"/>
<executable name="later" cmd="cat" tty="true"><depends_on process="sleeper" condition="exited"/></executable>)xml");
  RunningCommand run(launch({file}));
  ASSERT_TRUE(run.wait_for_output("[two-3]: process started", kPatience)) << run.out() << run.err();
  EXPECT_EQ(ask({"attach", "sleeper"}).err,
            "launch attach: error: 'sleeper-1' has no terminal of its own (system.launch.xml:2:2)\n"
            "      = help: write tty=\"true\" there, and let launch reload restart it\n");
  EXPECT_EQ(ask({"attach", "on"}).err,
            "launch attach: error: no process is named 'on'\n      = help: did you mean 'one'?\n");
  EXPECT_EQ(ask({"attach", "*o*"}).err,
            "launch attach: error: several processes are named '*o*': one-2, two-3\n      = help: name one of them\n");
  EXPECT_EQ(ask({"attach", "later"}).err, "launch attach: error: 'later' has not been started yet\n");
  EXPECT_EQ(ask({"stop", "two"}).exit_code, 0);
  EXPECT_EQ(ask({"attach", "two"}).err,
            "launch attach: error: 'two-3' does not run\n      = help: launch start starts it\n");
  EXPECT_EQ(ask({"complete", "attach", ""}).out, "later\none\none-2\ntwo\ntwo-3\n");
  run.send_signal(SIGINT);
  run.wait();
}

}  // namespace
