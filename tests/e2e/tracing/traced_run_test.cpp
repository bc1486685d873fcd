// SPDX-License-Identifier: Apache-2.0
// The fixture for traced systems, with the real launcher, tracer and nodes.
#include <gtest/gtest-spi.h>

#include <fstream>

#include "launch_trace_testing/traced_test.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using namespace launch_trace_testing;
using namespace std::chrono_literals;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

const fs::path kPingPong = EXAMPLES_DIRECTORY "/01_ping_pong.launch.xml";

RunOptions options(const fs::path& file, std::vector<std::pair<std::string, std::string>> arguments = {}) {
  return {.file = file, .arguments = std::move(arguments), .launch_program = LAUNCH_PROGRAM};
}

RunOptions programs(std::vector<Program> list) {
  return {.programs = std::move(list), .launch_program = LAUNCH_PROGRAM};
}

class TracedRun : public TracedTest {
 private:
  test_support::Sandbox sandbox_;  // is left when the run has ended
};

TEST_F(TracedRun, GivesTheTraceOfALaunchFile) {
  start(options(kPingPong, {{"count", "5"}, {"period_ms", "20"}}));
  const Trace trace = finish();
  EXPECT_THAT(trace, HasProcesses({"ping", "pong"}));
  EXPECT_THAT(trace,
              HasEvents(event("ros2:rcl_publisher_init").with("topic_name", "/ping").in_process("ping"), exactly(1)));
  EXPECT_THAT(trace, Delivers({.topic = "/ping", .publisher = "/ping", .subscriber = "/pong"}, at_least(5)));
  EXPECT_THAT(trace, Delivers({.topic = "/pong", .publisher = "/pong", .subscriber = "/ping"}, at_least(4)));
  const Event& answer = *event("ros2:rcl_publisher_init").with("topic_name", "/pong").in_process("pong").first(trace);
  EXPECT_THAT(
      trace, HappensBefore(
                 event("ros2:rcl_timer_init").in_process("ping"),
                 event("ros2:rcl_publish").in_process("pong").with("publisher_handle", answer.at("publisher_handle"))));
}

TEST_F(TracedRun, EndsASystemThatGoesOn) {
  start(options(kPingPong, {{"count", "0"}, {"period_ms", "20"}}));
  ASSERT_TRUE(run().wait_for_output("[pong-1] ")) << run().out() << run().err();
  const Trace trace = stop();
  EXPECT_THAT(trace, HasProcesses({"ping", "pong"}));
}

TEST_F(TracedRun, StartsProgramsWithAnyArguments) {
  start(programs({{"/bin/echo", "it's", "a \"$HOME\" <&>", "back\\slash"}, {"true"}}));
  const RunResult result = run().wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("it's a \"$HOME\" <&> back\\slash\n"));
}

// Without a trace of its own, whose name two systems that start in the same second would share.
fs::path untraced_ping_pong() {
  const fs::path file = fs::temp_directory_path() / "ping_pong.launch.xml";
  std::ofstream(file)
      << "<launch>\n  <arg name=\"count\"/>\n  <node pkg=\"demo_nodes\" exec=\"pong\"/>\n"
         "  <node pkg=\"demo_nodes\" exec=\"ping\" on_exit=\"shutdown\">\n"
         "    <param name=\"count\" value=\"$(var count)\"/>\n    <param name=\"period_ms\" value=\"20\"/>\n"
         "  </node>\n</launch>\n";
  return file;
}

TEST_F(TracedRun, SeesNothingOfASystemBesideIt) {
  const fs::path file = untraced_ping_pong();
  LaunchRun other(options(file, {{"count", "0"}}));
  ASSERT_TRUE(other.wait_for_output("[pong-1] ")) << other.out() << other.err();
  start(options(file, {{"count", "3"}}));
  EXPECT_NE(other.domain_id(), run().domain_id());
  const Trace trace = finish();
  EXPECT_THAT(trace, HasEvents(event("ros2:rcl_init"), exactly(2)));
  EXPECT_EQ(other.stop().exit_code, 0);
  EXPECT_THAT(other.trace(), HasEvents(event("ros2:rcl_init"), exactly(2)));
}

TEST_F(TracedRun, RecordsOnlyWhatIsAskedFor) {
  RunOptions asked = options(kPingPong, {{"count", "2"}, {"period_ms", "20"}});
  asked.events = {"ros2:rcl_init", "ros2:rcl_node_init"};
  start(std::move(asked));
  EXPECT_THAT(finish(), HasExactlyEventNames({"ros2:rcl_init", "ros2:rcl_node_init"}, "ros2*"));
}

TEST_F(TracedRun, ReadsTheTraceOfTheLaunchFileItself) {
  RunOptions asked = options(kPingPong, {{"count", "2"}, {"period_ms", "20"}});
  asked.events = {};
  start(std::move(asked));
  EXPECT_THAT(finish(), HasEvents(event("ros2:rcl_init"), exactly(2)));
}

// What a test says of a system whose process does this.
std::string failures_of(const std::string& script) {
  struct Ended : launch_trace_testing::TracedTest {
    void TestBody() override {}
    void run_script(const std::string& text) {
      RunOptions asked = programs({{"/bin/sh", "-c", text}});
      asked.events = {};
      start(std::move(asked));
      finish();
      end_of_test();
    }
    void end_of_test() { TearDown(); }
  };
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
    Ended().run_script(script);
  }
  std::string text;
  for (int i = 0; i < results.size(); ++i) {
    text += results.GetTestPartResult(i).message();
  }
  return text;
}

TEST(LaunchRunEnd, FailsTheTestIfAProcessHasCrashedOrWasLeft) {
  const test_support::Sandbox sandbox;
  // Each run has no trace, which is a failure, too.
  EXPECT_THAT(failures_of("true"), Not(AnyOf(HasSubstr("ended with 3"), HasSubstr("were left"))));
  EXPECT_THAT(failures_of("kill -SEGV $$"), HasSubstr("the launcher ended with 3"));
  // The shell waits until the other process is in its own session, and has given up the pipe.
  EXPECT_THAT(failures_of("x=$(setsid /bin/sh -c 'exec sleep 600 >/dev/null' &)"),
              AllOf(HasSubstr("processes were left running, and have been ended"), HasSubstr("sleep (")));
}

TEST(LaunchRunEnd, ACrashDuringTheShutdownIsInTheExitCode) {
  const test_support::Sandbox sandbox;
  RunOptions asked = programs({{"/usr/bin/python3", "-c",
                                "import os, signal\n"
                                "signal.signal(signal.SIGINT, lambda *_: os.kill(os.getpid(), signal.SIGSEGV))\n"
                                "print('ready', flush=True)\n"
                                "signal.pause()"}});
  asked.events = {};
  LaunchRun run(asked);
  ASSERT_TRUE(run.wait_for_output("ready"));
  const RunResult result = run.stop();
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  EXPECT_TRUE(result.left.empty());
}

TEST(LaunchRunEnd, IsEndedWhenPatienceIsOver) {
  const test_support::Sandbox sandbox;
  RunOptions asked = programs({{"sleep", "600"}});
  asked.events = {};
  asked.patience = 50ms;
  LaunchRun run(asked);
  constexpr int kLongestStart = 1200;  // calls, each of which waits for the 50 ms above
  for (int i = 0; i < kLongestStart && !run.wait_for_output("process started with pid"); ++i) {
    continue;
  }
  EXPECT_FALSE(run.wait_for_output("a text that never comes"));
  const RunResult result = run.wait();
  EXPECT_TRUE(result.timed_out);
  EXPECT_THAT(result.out + result.err, HasSubstr("user interrupted with ctrl-c (SIGINT)"));
}

TEST(LaunchRunEnd, LeavesNothingWhenItGoesOutOfScope) {
  const test_support::Sandbox sandbox;
  fs::path directory;
  {
    LaunchRun run(programs({{"sleep", "600"}}));
    directory = run.directory();
    EXPECT_TRUE(run.wait_for_output("process started with pid"));
  }
  EXPECT_FALSE(fs::exists(directory));
  const test_support::CommandResult sessions = test_support::run_command({"lttng", "list"});
  EXPECT_THAT(sessions.out + sessions.err, HasSubstr("Currently no available recording session"));
}

TEST(LaunchRunEnd, KeepsItsFilesIfAsked) {
  const test_support::Sandbox sandbox;
  fs::path directory;
  {
    LaunchRun run(programs({{"true"}}));
    directory = run.directory();
    EXPECT_EQ(run.wait().exit_code, 0);
    run.keep();
  }
  EXPECT_TRUE(fs::exists(directory / "traces"));
  EXPECT_TRUE(fs::exists(directory / "stdout.txt"));
}

TEST(LaunchRunFailure, TellsWhatTheLauncherSaid) {
  const test_support::Sandbox sandbox;
  const fs::path file = sandbox.directory() / "wrong.launch.xml";
  std::ofstream(file) << "<launch>\n  <nod pkg=\"demo_nodes\" exec=\"ping\"/>\n</launch>\n";
  LaunchRun run(options(file));
  EXPECT_EQ(run.wait().exit_code, 1);
  try {
    run.trace();
    ADD_FAILURE() << "no error";
  } catch (const TraceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the run has no trace; the launcher ended with 1 and said:\n"));
    EXPECT_THAT(error.what(), HasSubstr(file.string() + ":2:4: error: unrecognized entity of the type 'nod'"));
  }
}

TEST(LaunchRunFailure, ComesBeforeTheStartIfThereIsNoLauncher) {
  const test_support::Sandbox sandbox;
  RunOptions asked = programs({{"true"}});
  asked.launch_program = "/nonexistent/launch";
  try {
    LaunchRun run(asked);
    ADD_FAILURE() << "no error";
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "cannot start '/nonexistent/launch': No such file or directory");
  }
}

TEST(LaunchRunFailure, IsToldWhenTheTraceIsAskedForTooEarly) {
  const test_support::Sandbox sandbox;
  LaunchRun run(programs({{"sleep", "600"}}));
  try {
    run.trace();
    ADD_FAILURE() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(), "the run has not ended; call wait() or stop() first");
  }
}

}  // namespace
