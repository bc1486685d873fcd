// SPDX-License-Identifier: Apache-2.0
// launch top in a terminal of its own: what it shows, and what its keys do.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "tests/support/command.hpp"
#include "tests/support/plain_terminal.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/terminal.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr std::chrono::seconds kPatience{60};

class TopTest : public testing::Test {
 protected:
  TopTest() {
    fs::create_directory(sandbox_.directory() / "run");
    environment_ = plain_terminal(sandbox_);
    environment_["XDG_RUNTIME_DIR"] = sandbox_.directory() / "run";
  }

  Command launch(const std::string& actions) const {
    const fs::path path = sandbox_.directory() / "system.launch.xml";
    write_file(path, "<launch>\n" + actions + "\n</launch>\n");
    return {.argv = {LAUNCH_PROGRAM, path.string()}, .environment = environment_, .directory = sandbox_.directory()};
  }

  // Launches of other tests may run beside this one.
  static std::vector<std::string> top_of(const RunningCommand& run, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {LAUNCH_PROGRAM, "top", "--launch", std::to_string(run.pid())});
    return options;
  }

  Sandbox sandbox_;
  std::map<std::string, std::string> environment_;
};

const std::string kTalker = R"xml(<executable name="talker" shell="true" output="both"
    cmd="got() { echo got USR1; }; trap got USR1; echo ready; while :; do read x; done"/>)xml";

TEST_F(TopTest, ShowsProcessesAndItsKeysSteerThem) {
  RunningCommand run(launch(kTalker + R"xml(<executable name="sleeper" cmd="sleep 1000"/>)xml"));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("sleeper-2", "running")) << top.screen();
  EXPECT_THAT(top.line_with("NAME"), HasSubstr("CPU %     MEMORY RESTARTS  LINES/S"));
  EXPECT_THAT(top.line_with("launch " + std::to_string(run.pid())), HasSubstr("2 processes"));
  EXPECT_TRUE(top.shows("quit", "s start  x stop  r restart")) << top.screen();
  top.type("\033[B");  // down
  top.type("x");
  EXPECT_TRUE(top.shows("sleeper-2", "ended: SIGINT")) << top.screen();
  top.type("s");
  EXPECT_TRUE(top.shows("sleeper-2", "running")) << top.screen();
  top.type("/talk\r");
  EXPECT_TRUE(top.hides("sleeper-2")) << top.screen();
  EXPECT_TRUE(top.shows("only 'talk'"));
  top.type("l");
  EXPECT_TRUE(top.shows("Output of talker-1")) << top.screen();
  top.type("kUSR1\r");
  EXPECT_TRUE(top.shows("got USR1")) << top.screen();
  top.type("q");
  EXPECT_TRUE(top.shows("talker-1", "running")) << top.screen();
  top.type("kNOSUCH\r");
  EXPECT_TRUE(top.shows("there is no signal 'NOSUCH'")) << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, EndsWithTheLaunch) {
  RunningCommand run(launch(kTalker));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("talker-1", "running")) << top.screen();
  run.send_signal(SIGINT);
  EXPECT_EQ(top.wait(), 0);
  EXPECT_THAT(top.everything(), HasSubstr("launch " + std::to_string(run.pid()) + " has ended\r\n"));
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, ALaunchBeginsInItAndGoesOnWithPlainLines) {
  Terminal terminal({LAUNCH_PROGRAM, "--top", launch(kTalker).argv[1]}, environment_);
  ASSERT_TRUE(terminal.shows("talker-1", "running")) << terminal.everything();
  terminal.type("l");
  EXPECT_TRUE(terminal.shows("Output of talker-1")) << terminal.screen();
  terminal.type("kUSR1\r");
  EXPECT_TRUE(terminal.shows("got USR1")) << terminal.screen();
  terminal.type("qq");
  EXPECT_TRUE(terminal.shows("[talker-1] got USR1")) << terminal.everything();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 0) << terminal.everything();
  EXPECT_THAT(terminal.everything(), HasSubstr("user interrupted with ctrl-c (SIGINT)"));
}

TEST_F(TopTest, CtrlCEndsTheLaunchThatBeganInIt) {
  Terminal terminal({LAUNCH_PROGRAM, "--top", launch(kTalker).argv[1]}, environment_);
  ASSERT_TRUE(terminal.shows("talker-1", "running")) << terminal.everything();
  terminal.type("\003");
  EXPECT_EQ(terminal.wait(), 0) << terminal.everything();
  EXPECT_THAT(terminal.everything(), HasSubstr("user interrupted with ctrl-c (SIGINT)"));
}

TEST_F(TopTest, ALaunchThatCannotBeginInItSaysWhy) {
  Terminal terminal({LAUNCH_PROGRAM, "--top", launch("<executable/>").argv[1]}, environment_);
  EXPECT_EQ(terminal.wait(), 1);
  EXPECT_THAT(terminal.everything(), HasSubstr("system.launch.xml:2:2: error: "));
  const CommandResult none = run_command({LAUNCH_PROGRAM, "--top", "any.launch.xml"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err,
            "launch: error: --top needs a terminal\n      = help: 'launch ps' prints a table\n"
            "      = help: see 'launch --help'\n");
}

TEST_F(TopTest, FiveHundredProcessesAreScrolledAndALargerTerminalShowsMore) {
  std::string actions;
  for (int i = 1; i <= 500; ++i) {
    actions += "<executable name=\"node\" cmd=\"sleep 1000\"/>\n";
  }
  RunningCommand run(launch(actions));
  ASSERT_TRUE(run.wait_for_output("[node-500]: process started", kPatience));
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("node-20 ", "running")) << top.screen();
  EXPECT_EQ(top.line_with("node-21 "), "");
  EXPECT_THAT(top.line_with("processes"), HasSubstr("500 processes"));
  top.type("\033[F");  // end
  EXPECT_TRUE(top.shows("node-500 ", "running")) << top.screen();
  top.type("\033[H");  // home
  EXPECT_TRUE(top.shows("node-1 ", "running")) << top.screen();
  top.resize(40, 120);
  EXPECT_TRUE(top.shows("node-36 ", "system.launch.xml:37")) << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
}

// What ends below the end of that heading, in the line that begins with `name` of a table that begins with `title`. The
// table leaves columns out where it would be too wide, so their places are not known.
std::string figure_of(const std::string& report, const std::string& title, const std::string& name,
                      const std::string& heading) {
  const std::size_t table = report.find("\n" + title + " ");
  const std::size_t row = table == std::string::npos ? table : report.find("\n  " + name + " ", table);
  if (row == std::string::npos) {
    return "no row '" + name + "' in '" + title + "'";
  }
  const std::size_t column = report.substr(table, report.find('\n', table + 1) - table).find(" " + heading);
  if (column == std::string::npos) {
    return "no column '" + heading + "' in '" + title + "'";
  }
  const std::string before = report.substr(row, column + 1 + heading.size());
  return before.substr(before.rfind(' ') + 1);
}

TEST_F(TopTest, ShowsWhatTheNodesDoAndSaysAtTheEndWhatTheTraceSays) {
  const fs::path beats = sandbox_.directory() / "beats";
  ASSERT_EQ(::mkfifo(beats.c_str(), 0600), 0);
  const int fifo = ::open(beats.c_str(), O_RDWR | O_CLOEXEC);
  RunningCommand run(
      launch("<trace session-name=\"all\"/><executable name=\"worker\" output=\"both\" shell=\"true\" cmd=\"exec " +
             std::string(WORKER) + " &lt; " + beats.string() + "\"/>"));
  ASSERT_TRUE(run.wait_for_output("[worker-1]: process started", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run, {"--trace"}), environment_);
  ASSERT_TRUE(top.shows("events/s", "messages/s")) << top.screen();  // the worker has told of its objects again
  EXPECT_THAT(top.line_with("What the nodes do"), Not(""));
  ASSERT_EQ(::write(fifo, "120\n", 4), 4);
  ASSERT_TRUE(run.wait_for_output("[worker-1] done", kPatience));
  EXPECT_TRUE(top.shows("  /beats  to /beat ")) << top.screen();
  EXPECT_TRUE(top.shows("  /beat timer 1 ms ")) << top.screen();
  EXPECT_THAT(top.screen(), HasSubstr("none lost"));
  top.resize(30, 100);
  EXPECT_TRUE(top.shows("  /beat subscription /beats ")) << top.screen();
  top.type("/timer\r");
  EXPECT_TRUE(top.hides("/beats  to /beat")) << top.screen();
  EXPECT_TRUE(top.shows("What the nodes do, only rows with 'timer'"));
  top.type("t");
  EXPECT_TRUE(top.shows("worker-1", "running")) << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
  ::close(fifo);

  std::string seen = top.everything().substr(top.everything().find("Trace      what launch top has recorded"));
  std::erase(seen, '\r');
  const CommandResult offline = run_command({LAUNCH_REPORT, sandbox_.directory() / "traces" / "all"});
  EXPECT_EQ(offline.exit_code, 0) << offline.err;
  EXPECT_THAT(seen, HasSubstr("\nLosses     no events lost\n"));
  EXPECT_EQ(figure_of(seen, "Callbacks", "/beat, timer 1 ms", "count"), "120") << seen;
  EXPECT_EQ(figure_of(seen, "Topics", "/beats", "sent"), "120");
  for (const char* column : {"sent", "received", "dropped"}) {
    EXPECT_EQ(figure_of(seen, "Topics", "/beats", column), figure_of(offline.out, "Topics", "/beats", column));
  }
  // The times are not compared: the two sessions take the time of an event one after the other.
  EXPECT_EQ(figure_of(offline.out, "Callbacks", "/beat, timer 1 ms", "count"), "120") << offline.out;
  // Nothing of the recording is left.
  EXPECT_EQ(run_command({"lttng", "list"}).out.find("launch-top"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(sandbox_.directory() / "tmp"));
}

TEST_F(TopTest, KnowsTheStateOfLifecycleNodesThatAreOlder) {
  RunningCommand run(launch(
      R"xml(<lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="led" namespace="/here" autostart="true"/>
<executable cmd="echo it is active" name="state" output="both"><depends_on node="/here/led" state="active"/></executable>)xml"));
  ASSERT_TRUE(run.wait_for_output("it is active", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run, {"--trace"}), environment_);
  ASSERT_TRUE(top.shows("  /here/led timer ")) << top.screen();
  top.type("q");
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
  std::string seen = top.everything();
  std::erase(seen, '\r');
  EXPECT_EQ(figure_of(seen, "Lifecycle nodes", "/here/led", "state at the end"), "active") << seen;
}

TEST_F(TopTest, ARecordingOfTheNodesThatCrashesBeginsAnew) {
  RunningCommand run(launch(R"xml(<lifecycle_node pkg="lifecycle" exec="lifecycle_talker" name="led" namespace="/here"
    autostart="true"/><trace session-name="all"/>)xml"));
  ASSERT_TRUE(run.wait_for_output("[lifecycle_talker-1]: process started", kPatience)) << run.out() << run.err();
  Terminal top(top_of(run, {"--trace"}), environment_);
  const auto crash = [&] {
    const std::string watch = run_command({"pgrep", "-P", std::to_string(top.pid()), "launch-watch"}).out;
    ASSERT_NE(watch, "");
    ASSERT_EQ(::kill(std::stoi(watch), SIGSEGV), 0);
  };
  for (int crashes = 1; crashes <= 2; ++crashes) {
    ASSERT_TRUE(top.shows("  /here/led timer ")) << top.screen();
    crash();
    ASSERT_TRUE(top.shows("launch-watch was ended by SIGSEGV. The recording of the nodes begins anew."))
        << top.screen();
  }
  ASSERT_TRUE(top.shows("  /here/led timer ")) << top.screen();
  crash();
  ASSERT_TRUE(top.hides("  /here/led timer ")) << top.screen();
  EXPECT_TRUE(top.shows("launch-watch was ended by SIGSEGV")) << top.screen();
  top.type("tq");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait(kPatience).exit_code, 0);
}

TEST_F(TopTest, SaysWhyItCannotShowWhatTheNodesDo) {
  RunningCommand run(launch(kTalker));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  environment_["PATH"] = sandbox_.directory();
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("talker-1", "running")) << top.screen();
  top.type("t");
  EXPECT_TRUE(top.shows("there is no 'lttng-relayd' on this machine")) << top.screen();
  EXPECT_TRUE(top.shows("= help: install the package lttng-tools")) << top.screen();
  top.type("tq");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, AStoppedProcessIsStopped) {
  RunningCommand run(launch(R"xml(<executable name="sleeper" cmd="sleep 1000"/>)xml"));
  ASSERT_TRUE(run.wait_for_output("[sleeper-1]: process started", kPatience));
  Terminal top(top_of(run), environment_);
  ASSERT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  top.type("kSTOP\r");
  EXPECT_TRUE(top.shows("sleeper-1", "stopped")) << top.screen();
  const CommandResult ps =
      run_command({.argv = {LAUNCH_PROGRAM, "ps", "--launch", std::to_string(run.pid())}, .environment = environment_});
  EXPECT_THAT(ps.out, testing::ContainsRegex("sleeper-1 +stopped ")) << ps.err;
  top.type("kCONT\r");
  EXPECT_TRUE(top.shows("sleeper-1", "running")) << top.screen();
  top.type("q");
  EXPECT_EQ(top.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, LongNamesAreCutInTheMiddle) {
  RunningCommand run(launch(R"xml(<executable name="driver_of_the_camera_left" cmd="sleep 1000"/>
    <executable name="driver_of_the_camera_right" cmd="sleep 1000"/>)xml"));
  ASSERT_TRUE(run.wait_for_output("right-2]: process started", kPatience));
  for (const auto& [language, dots] : {std::pair("C.UTF-8", "…"), std::pair("C", "~")}) {
    environment_["LC_ALL"] = language;
    Terminal top(top_of(run), environment_);
    EXPECT_TRUE(top.shows(fmt::format("drive{}era_left-1 running", dots))) << top.screen();
    EXPECT_TRUE(top.shows(fmt::format("drive{}ra_right-2 running", dots))) << top.screen();
    EXPECT_THAT(top.line_with("NAME"), HasSubstr("LINES/S")) << "all figures are seen";
    top.type("q");
    EXPECT_EQ(top.wait(), 0);
  }
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, APromptThatFollowsHasALineOfItsOwn) {
  RunningCommand run(launch(kTalker));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  const std::string top_and_prompt =
      LAUNCH_PROGRAM " top --launch " + std::to_string(run.pid()) + "; printf 'prompt$ '";
  Terminal shell({"/bin/sh", "-c", top_and_prompt}, environment_);
  ASSERT_TRUE(shell.shows("talker-1", "running")) << shell.screen();
  ASSERT_TRUE(shell.shows("quit"));
  shell.type("q");
  EXPECT_TRUE(shell.shows_line("prompt$")) << shell.screen();
  EXPECT_EQ(shell.wait(), 0);
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, SaysThatATerminalCannotBeDrawnOn) {
  RunningCommand run(launch(kTalker));
  ASSERT_TRUE(run.wait_for_output("[talker-1] ready", kPatience));
  for (const char* const type : {"dumb", ""}) {
    environment_["TERM"] = type;
    Terminal top(top_of(run), environment_);
    EXPECT_EQ(top.wait(), 1);
    EXPECT_THAT(top.everything(),
                HasSubstr("launch top: error: nothing can be drawn on this terminal (TERM is 'dumb' or "
                          "empty); 'launch ps' prints a table\r\n"));
  }
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(TopTest, NeedsATerminal) {
  const CommandResult result = run_command({.argv = {LAUNCH_PROGRAM, "top"}, .environment = environment_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "launch top: error: needs a terminal\n      = help: 'launch ps' prints a table\n");
}

}  // namespace
