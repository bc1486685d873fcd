// SPDX-License-Identifier: Apache-2.0
// `launch report --live` beside a traced program: what it shows while the program runs, and that it says the same at
// the end as the report of the whole trace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using ::testing::HasSubstr;

constexpr std::chrono::seconds kPatience{90};

class LiveReport : public ::testing::Test {
 protected:
  // Starts a session that records everything. `where` are the options that say where its trace goes.
  void start_session(const std::vector<std::string>& where) {
    if (!std::exchange(has_daemon_, true)) {
      ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
    }
    std::vector<std::string> create{"lttng", "create", "seen"};
    create.insert(create.end(), where.begin(), where.end());
    run(create);
    // As a user with such a session has it: packets come though they are not full.
    run({"lttng", "enable-channel", "-u", "--subbuf-size=64K", "--switch-timer=50000", "channel"});
    run({"lttng", "enable-event", "-u", "-c", "channel", "ros2*"});
    run({"lttng", "add-context", "-u", "-c", "channel", "-t", "vpid", "-t", "vtid", "-t", "procname"});
    run({"lttng", "start"});
  }

  void run(const std::vector<std::string>& command) {
    const CommandResult result = run_command(command);
    ASSERT_EQ(result.exit_code, 0) << command[1] << result.out << result.err;
  }

  // Whether a relay daemon listens, within the patience of the test.
  static bool accepts_viewers() {
    constexpr std::uint16_t kPort = 5344;
    const auto until = std::chrono::steady_clock::now() + kPatience;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(kPort);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    while (std::chrono::steady_clock::now() < until) {
      const int probe = socket(AF_INET, SOCK_STREAM, 0);
      const bool accepts = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
      close(probe);
      if (accepts) {
        return true;
      }
      std::this_thread::yield();
    }
    return false;
  }

  static void beat(RunningCommand& worker, const std::string& times) {
    worker.write(times + "\n");
    ASSERT_TRUE(worker.wait_for_output("done")) << worker.out() << worker.err();
  }

  static std::string report(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{LAUNCH_REPORT};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const CommandResult result = run_command(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }

  test_support::Sandbox sandbox_;
  bool has_daemon_ = false;
};

TEST_F(LiveReport, OfASessionSaysAtTheEndWhatTheTraceSays) {
  const fs::path relayed = sandbox_.directory() / "relayed";
  ASSERT_EQ(run_command({"lttng-relayd", "--daemonize", "--output=" + relayed.string()}).exit_code, 0);
  RunningCommand live({.argv = {LAUNCH_REPORT, "--live", "seen", "--json", "--interval=0.1"}});
  ASSERT_TRUE(live.wait_for_output("waiting for the session 'seen'", kPatience)) << live.err();
  start_session({"--live=50000"});
  ASSERT_TRUE(live.wait_for_output("attached to the session 'seen'", kPatience)) << live.err();
  {
    RunningCommand worker({.argv = {WORKER}});
    beat(worker, "50");
    // The messages have a latency, so everything about them is there.
    EXPECT_TRUE(live.wait_for_output("none lost", kPatience)) << live.err();
    EXPECT_TRUE(live.wait_for_output("latency p50", kPatience)) << live.err();
    beat(worker, "70");
    worker.close_input();
    EXPECT_EQ(worker.wait().exit_code, 0);
  }
  run({"lttng", "destroy", "seen"});
  const CommandResult ended = live.wait(kPatience);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, testing::Not(HasSubstr("has begun before")));

  nlohmann::json seen = nlohmann::json::parse(ended.out, nullptr, false);
  nlohmann::json expected = nlohmann::json::parse(report({"--json", relayed.string()}), nullptr, false);
  ASSERT_FALSE(seen.is_discarded()) << ended.out;
  ASSERT_FALSE(expected.is_discarded());
  EXPECT_EQ(expected["directory"], relayed.string());
  EXPECT_THAT(seen["directory"].get<std::string>(), testing::StartsWith("net://localhost/host/"));
  seen["directory"] = expected["directory"];
  EXPECT_EQ(seen.dump(1), expected.dump(1));
  EXPECT_THAT(ended.out, HasSubstr("Beat::on_message()"));
  EXPECT_THAT(ended.out, HasSubstr("\"count\": 120"));
}

// LTTng describes the events when a traced program ends, so what comes after the first worker is seen at once.
TEST_F(LiveReport, OfADirectorySaysAtTheEndWhatTheTraceSays) {
  const fs::path directory = sandbox_.directory() / "trace";
  fs::create_directories(directory);
  RunningCommand live({.argv = {LAUNCH_REPORT, "--live", directory.string(), "--interval=0.1"}});
  ASSERT_TRUE(live.wait_for_output("waiting for a trace in " + directory.string(), kPatience)) << live.err();
  start_session({"--output=" + directory.string()});
  for (const std::string processes : {"1 process", "2 processes"}) {
    RunningCommand worker({.argv = {WORKER}});
    beat(worker, "50");
    if (processes != "1 process") {
      EXPECT_TRUE(live.wait_for_output(" events, 2 processes, none lost", kPatience)) << live.out() << live.err();
    }
    worker.close_input();
    EXPECT_EQ(worker.wait().exit_code, 0);
    EXPECT_TRUE(live.wait_for_output(" events, " + processes + ", none lost", kPatience)) << live.out() << live.err();
  }
  run({"lttng", "destroy", "seen"});
  const CommandResult ended = live.wait(kPatience);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::size_t begin = ended.out.find("Trace      ");
  ASSERT_NE(begin, std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.substr(begin), report({directory.string()}));
  EXPECT_THAT(ended.out.substr(begin), HasSubstr("/beats"));
}

// The sessions of a relay daemon end with it. The view waits for another daemon, and for another session of this name.
TEST_F(LiveReport, GoesOnAfterItsRelayDaemonWasRestarted) {
  const Command relay_daemon{.argv = {"lttng-relayd", "--output=" + (sandbox_.directory() / "relayed").string()}};
  auto relay = std::make_unique<RunningCommand>(relay_daemon);
  ASSERT_TRUE(accepts_viewers());
  RunningCommand live({.argv = {LAUNCH_REPORT, "--live", "seen", "--json", "--interval=0.1"}});
  for (const std::string events : {"50", "70"}) {
    start_session({"--live=50000"});
    const std::string attached = events == "50" ? "attached to the session 'seen'" : "the view goes on";
    ASSERT_TRUE(live.wait_for_output(attached, kPatience)) << live.err();
    {
      RunningCommand worker({.argv = {WORKER}});
      beat(worker, events);
      EXPECT_TRUE(live.wait_for_output("latency p50", kPatience)) << live.err();
      worker.close_input();
      EXPECT_EQ(worker.wait().exit_code, 0);
    }
    if (events == "50") {
      relay->send_signal(SIGKILL);
      relay->wait();
      ASSERT_TRUE(live.wait_for_output("waiting for a session 'seen' of another one", kPatience)) << live.err();
      run({"lttng", "destroy", "--no-wait", "seen"});
      relay = std::make_unique<RunningCommand>(relay_daemon);
      ASSERT_TRUE(accepts_viewers());
    }
  }
  run({"lttng", "destroy", "seen"});
  const CommandResult ended = live.wait(kPatience);
  EXPECT_EQ(ended.exit_code, 1) << "what was recorded without a relay daemon is missing";
  EXPECT_THAT(ended.out, HasSubstr("the relay daemon was restarted"));
  EXPECT_THAT(ended.out, HasSubstr("\"count\": 50"));
  EXPECT_THAT(ended.out, HasSubstr("\"count\": 70"));
}

TEST_F(LiveReport, EndsWhenItsRelayDaemonDoesNotComeBack) {
  auto relay = std::make_unique<RunningCommand>(
      Command{.argv = {"lttng-relayd", "--output=" + (sandbox_.directory() / "relayed").string()}});
  ASSERT_TRUE(accepts_viewers());
  RunningCommand live({.argv = {LAUNCH_REPORT, "--live", "seen"}});
  start_session({"--live=50000"});
  ASSERT_TRUE(live.wait_for_output("attached to the session 'seen'", kPatience)) << live.err();
  relay->send_signal(SIGKILL);
  relay->wait();
  EXPECT_EQ(live.wait(kPatience).exit_code, 1);
  run({"lttng", "destroy", "--no-wait", "seen"});
}

TEST_F(LiveReport, EndsWithAReportWhenTheUserEndsIt) {
  const fs::path directory = sandbox_.directory() / "trace";
  start_session({"--output=" + directory.string()});
  {
    RunningCommand worker({.argv = {WORKER}});
    beat(worker, "50");
    worker.close_input();
    EXPECT_EQ(worker.wait().exit_code, 0);
  }
  RunningCommand live({.argv = {LAUNCH_REPORT, "--live", directory.string(), "--interval=0.1"}});
  EXPECT_TRUE(live.wait_for_output(" events, 1 process, none lost", kPatience)) << live.out() << live.err();
  live.send_signal(SIGINT);
  const CommandResult ended = live.wait(kPatience);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("Trace      " + directory.string()));
  run({"lttng", "destroy", "seen"});
}

TEST_F(LiveReport, SaysWhatIsMissing) {
  const CommandResult no_daemon = run_command({LAUNCH_REPORT, "--live", "seen"});
  EXPECT_EQ(no_daemon.exit_code, 1);
  EXPECT_EQ(
      no_daemon.err,
      "launch report: error: no relay daemon answers at net://localhost\n"
      "      = help: a live session goes to a relay daemon: start 'lttng-relayd', and give the session a live-timer\n");
  const CommandResult no_address = run_command({LAUNCH_REPORT, "--live", "http://localhost/seen"});
  EXPECT_EQ(no_address.exit_code, 1);
  EXPECT_EQ(no_address.err,
            "launch report: error: 'http://localhost/seen' is no address of a live session\n"
            "      = help: write net://RELAY[:PORT]/host/HOST/SESSION, or the name of a session of this machine\n");
  const CommandResult together = run_command({LAUNCH_REPORT, "--live", "seen", "--html", "page.html"});
  EXPECT_EQ(together.exit_code, 2);
  EXPECT_THAT(together.err, HasSubstr("--live excludes --html"));
}

}  // namespace
