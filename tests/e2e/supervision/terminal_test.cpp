// SPDX-License-Identifier: Apache-2.0
// launch on a terminal: its status line while it starts and stops, and processes that read the terminal.
#include "tests/support/terminal.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class OnATerminal : public testing::Test {
 protected:
  std::vector<std::string> launch(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return {LAUNCH_PROGRAM, path.string()};
  }
  // What is typed before a shell shows its prompt may be lost. The prompts of this shell are "<1>", "<2>" and so on.
  std::map<std::string, std::string> with_numbered_prompts() const {
    auto environment = environment_;
    environment["PS1"] = "<\\#> ";
    return environment;
  }

  Sandbox sandbox_;
  std::map<std::string, std::string> environment_ = {{"TERM", "xterm"}, {"NO_COLOR", "1"}};
};

TEST_F(OnATerminal, AStatusLineTellsOfASlowStartAndASlowEnd) {
  const std::string fifo = (sandbox_.directory() / "fifo").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  Terminal terminal(launch("<executable name=\"gate\" shell=\"true\" output=\"screen\" sigterm_timeout=\"2\"\n"
                           "  cmd=\"trap : INT; cat " +
                           fifo +
                           "; while :; do read x; done\"/>\n"
                           "<executable name=\"late\" cmd=\"echo here\" output=\"screen\">"
                           "<depends_on process=\"gate\" condition=\"output\" pattern=\"open\"/></executable>"),
                    environment_);
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  std::ofstream gate(fifo);
  gate << "not yet" << std::endl;
  ASSERT_TRUE(terminal.shows("[gate-1] not yet")) << terminal.screen();
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  EXPECT_THAT(terminal.screen(), HasSubstr("[gate-1] not yet\nstarting 1 of 2, waiting: late\n"));
  gate << "open" << std::endl;
  ASSERT_TRUE(terminal.shows("[late-2] here")) << terminal.screen();
  ASSERT_TRUE(terminal.hides("starting ")) << terminal.screen();
  ASSERT_TRUE(terminal.shows("[INFO] [late-2]: process has finished cleanly")) << terminal.screen();
  gate.close();
  terminal.type("\003");
  ASSERT_TRUE(terminal.shows("stopping: 1 of 1 still run, SIGTERM in ", ": gate-1")) << terminal.screen();
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
  EXPECT_THAT(terminal.screen(), Not(HasSubstr("stopping:")));
  EXPECT_THAT(terminal.screen(), HasSubstr("\n[INFO] [late-2]: process has finished cleanly"));
}

TEST_F(OnATerminal, AQuickLaunchHasNoStatusLine) {
  Terminal terminal(launch("<executable name=\"quick\" cmd=\"echo here\" output=\"screen\"/>"), environment_);
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_THAT(terminal.screen(), HasSubstr("[quick-1] here\n"));
  EXPECT_THAT(terminal.everything(), Not(HasSubstr("\033")));
}

pid_t first_child(pid_t parent) {
  const std::string number = std::to_string(parent);
  std::ifstream children("/proc/" + number + "/task/" + number + "/children");
  pid_t child = -1;
  children >> child;
  return child;
}

// The spare guardian is the child of the guardian, which the user has started, and the launcher is the child of the
// spare.
pid_t launcher_below(pid_t guardian) {
  return first_child(first_child(guardian));
}

TEST_F(OnATerminal, TheStatusLineOfAKilledLauncherIsErased) {
  Terminal terminal(launch("<executable name=\"late\" cmd=\"true\">"
                           "<depends_on process=\"gate\" condition=\"output\" pattern=\"open\"/></executable>"
                           "<executable name=\"gate\" cmd=\"sleep 1000\"/>"),
                    environment_);
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  ::kill(launcher_below(terminal.pid()), SIGKILL);
  EXPECT_EQ(terminal.wait(), -1);
  EXPECT_THAT(terminal.screen(),
              HasSubstr("\n[ERROR] [launch]: the launcher was ended by SIGKILL: ending 1 process\n"));
  EXPECT_THAT(terminal.screen(), Not(HasSubstr("starting 1 of 2")));
}

TEST_F(OnATerminal, TheStatusLineFollowsTheSizeOfTheTerminal) {
  Terminal terminal(launch("<executable name=\"late\" cmd=\"true\">"
                           "<depends_on process=\"gate\" condition=\"output\" pattern=\"open\"/></executable>"
                           "<executable name=\"gate\" shell=\"true\" output=\"screen\" cmd=\"say() { echo two; }; trap "
                           "say USR1; echo one;"
                           " while :; do read x; done\"/>"),
                    environment_);
  ASSERT_TRUE(terminal.shows("starting 1 of 2, waiting: late")) << terminal.screen();
  terminal.resize(24, 20);
  run_command({LAUNCH_PROGRAM, "signal", "gate", "USR1"});
  ASSERT_TRUE(terminal.shows("[gate-1] two")) << terminal.screen();
  // It leaves a column free.
  ASSERT_TRUE(terminal.shows_line("starting 1 of 2, wa")) << terminal.screen();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
}

TEST_F(OnATerminal, ATerminalThatIsClosedEndsEverything) {
  Terminal terminal(launch("<executable name=\"node\" shell=\"true\" output=\"screen\""
                           " cmd=\"echo here; setsid sleep 1000 &amp; while :; do read x; done\"/>"),
                    environment_);
  ASSERT_TRUE(terminal.shows("[node-1] here")) << terminal.screen();
  EXPECT_EQ(terminal.close(), 0);
  Sandbox::wait_until_daemons_are_left();
}

TEST_F(OnATerminal, AProcessCanHaveTheTerminal) {
  Terminal terminal(
      launch("<executable name=\"ask\" shell=\"true\" output=\"screen\" stdin=\"terminal\""
             " cmd=\"echo ready; read word; echo got $word\"/>"
             "<executable name=\"other\" shell=\"true\" output=\"screen\" cmd=\"test -t 0 || echo none\"/>"),
      environment_);
  ASSERT_TRUE(terminal.shows("[ask-1] ready")) << terminal.screen();
  terminal.type("hello\n");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
  EXPECT_THAT(terminal.screen(), HasSubstr("\n[ask-1] got hello\n"));
  EXPECT_THAT(terminal.screen(), HasSubstr("\n[other-2] none\n"));
}

TEST_F(OnATerminal, CtrlCReachesTheProcessThatHasTheTerminalOnce) {
  Terminal terminal(
      launch("<executable name=\"ask\" shell=\"true\" output=\"screen\" stdin=\"terminal\" respawn=\"true\""
             " cmd=\"interrupted() { echo interrupted; }; ended() { echo ended; exit 7; }; trap interrupted INT; trap "
             "ended TERM; echo ready;"
             " while :; do sleep 1000; done\" sigterm_timeout=\"0.5\"/>"),
      environment_);
  ASSERT_TRUE(terminal.shows("[ask-1] ready")) << terminal.screen();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
  const std::string all = terminal.screen();
  EXPECT_THAT(all, HasSubstr("[ask-1] interrupted\n"));
  EXPECT_EQ(all.find("[ask-1] interrupted"), all.rfind("[ask-1] interrupted")) << all;
  EXPECT_THAT(all, HasSubstr("[INFO] [ask-1]: sending signal 'SIGTERM' to process[ask-1]\n"));
  EXPECT_THAT(all, HasSubstr("[ask-1] ended\n"));
}

TEST_F(OnATerminal, AProcessThatReadsTheTerminalFromTheBackgroundIsToldOf) {
  Terminal terminal(launch("<executable name=\"ask\" shell=\"true\" cmd=\"read word &lt; /dev/tty\"/>"), environment_);
  ASSERT_TRUE(terminal.shows("[WARNING] [ask-1]: process waits for terminal input; stdin=\"terminal\" lets it"))
      << terminal.screen();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
}

TEST_F(OnATerminal, InTheBackgroundOfAShellItWaitsForTheForeground) {
  const std::vector<std::string> words = launch(
      "<executable name=\"ask\" shell=\"true\" output=\"screen\" stdin=\"terminal\""
      " cmd=\"read word; echo got $word\"/>");
  Terminal terminal({"/bin/bash", "--norc", "--noprofile", "-i"}, with_numbered_prompts());
  ASSERT_TRUE(terminal.shows("<1>")) << terminal.screen();
  terminal.type(words[0] + " " + words[1] + " &\n");
  ASSERT_TRUE(terminal.shows("[WARNING] [ask-1]: process waits for terminal input; it goes on when the launch is in"))
      << terminal.screen();
  terminal.type("fg\n");
  terminal.type("hello\n");
  ASSERT_TRUE(terminal.shows("[ask-1] got hello")) << terminal.screen();
  terminal.type("exit\n");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
}

TEST_F(OnATerminal, CtrlZStopsAndFgContinuesAProcessThatHasTheTerminal) {
  const std::vector<std::string> words = launch(
      "<executable name=\"ask\" shell=\"true\" output=\"screen\" stdin=\"terminal\""
      " cmd=\"echo ready; read word; echo got $word\"/>");
  Terminal terminal({"/bin/bash", "--norc", "--noprofile", "-i"}, with_numbered_prompts());
  ASSERT_TRUE(terminal.shows("<1>")) << terminal.screen();
  terminal.type(words[0] + " " + words[1] + "\n");
  ASSERT_TRUE(terminal.shows("[ask-1] ready")) << terminal.screen();
  terminal.type("\032");
  ASSERT_TRUE(terminal.shows("Stopped")) << terminal.screen();
  ASSERT_TRUE(terminal.shows("<2>")) << terminal.screen();
  terminal.type("fg\n");
  ASSERT_TRUE(terminal.shows("[INFO] [launch]: continuing the system")) << terminal.screen();
  terminal.type("hello\n");
  ASSERT_TRUE(terminal.shows("[ask-1] got hello")) << terminal.screen();
  terminal.type("exit\n");
  EXPECT_EQ(terminal.wait(), 0) << terminal.screen();
}

TEST_F(OnATerminal, TheModesOfTheTerminalAreSetBackWhenAProcessIsKilled) {
  Terminal terminal(launch("<executable name=\"raw\" shell=\"true\" output=\"screen\" stdin=\"terminal\""
                           " cmd=\"stty -echo -icanon; echo ready; read word; kill -9 $$\"/>"
                           "<executable cmd=\"sleep 1000\"/>"),
                    environment_);
  const tcflag_t before = terminal.local_modes();
  ASSERT_TRUE(terminal.shows("[raw-1] ready")) << terminal.screen();
  EXPECT_EQ(terminal.local_modes() & (ECHO | ICANON), 0U);
  terminal.type("\n");
  ASSERT_TRUE(terminal.shows("[ERROR] [raw-1]: process has died")) << terminal.screen();
  EXPECT_EQ(terminal.local_modes(), before);
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 3) << terminal.screen();
}

TEST_F(OnATerminal, TheGuardianSetsTheModesBackAfterAKilledLauncher) {
  Terminal terminal(launch("<executable name=\"raw\" shell=\"true\" output=\"screen\" stdin=\"terminal\""
                           " sigterm_timeout=\"0.1\" sigkill_timeout=\"0.1\""
                           " cmd=\"trap : INT TERM; stty -echo -icanon; echo ready; while :; do read word; done\"/>"),
                    environment_);
  const tcflag_t before = terminal.local_modes();
  ASSERT_TRUE(terminal.shows("[raw-1] ready")) << terminal.screen();
  ::kill(launcher_below(terminal.pid()), SIGKILL);
  EXPECT_EQ(terminal.wait(), -1) << terminal.screen();
  EXPECT_EQ(terminal.local_modes(), before);
}

}  // namespace
