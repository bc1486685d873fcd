// SPDX-License-Identifier: Apache-2.0
// LTTng's daemons that are killed or stopped: one clear error, no application blocks, and no session stays.
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/processes/process_stat.hpp"
#include "tests/support/command.hpp"
#include "tests/unit/session/robust_control.hpp"
#include "tracing/record/lttng/consumer_priority.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace trace_test {
namespace {

using test_support::run_command;
using testing::HasSubstr;
using testing::StartsWith;

struct DaemonFaults : RobustControl {};

TEST_F(DaemonFaults, AKilledConsumerIsAnErrorAndBlocksNoApplication) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  TracedApp app(10, 10);
  kill_processes("lttng-consumerd");
  app.fire_again();
  app.end();
  const std::string error = error_of([this] { tracer->finish(config(), never); });
  EXPECT_THAT(error, HasSubstr("run"));
  EXPECT_NE(error, "no error");
  // Sometimes LTTng's daemon ends with its consumer: then there is no session, either.
  EXPECT_THAT(listed_sessions(), testing::AnyOf("", HasSubstr("No session daemon is available")));
  signal(SIGPIPE, SIG_IGN);  // as launch does; LTTng's library writes to a daemon that may have ended
  const tracing::SetupReport next = tracer->start(config("next"));
  EXPECT_TRUE(next.started_daemon ||
              next.warnings == std::vector<std::string>{"LTTng's consumer had been killed; the session daemon, which a "
                                                        "launch had started, was restarted"});
  TracedApp(10, 10).end();
  tracer->finish(config("next"), never);
  EXPECT_EQ(read_trace(config("next").trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

// A daemon that somebody else has started, or that others use, is not ended.
TEST_F(DaemonFaults, AfterAKilledConsumerADaemonOfOthersIsToldOf) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  tracer->start(config());
  const pid_t daemon = tracing::session_daemon_pid();
  kill_processes("lttng-consumerd");
  error_of([this] { tracer->finish(config(), never); });
  signal(SIGPIPE, SIG_IGN);
  const std::string error = error_of([this] { tracer->start(config("next")); });
  // Sometimes LTTng's daemon ends with its consumer.
  if (processes("lttng-sessiond") == std::vector<pid_t>{daemon}) {
    EXPECT_THAT(error,
                HasSubstr("restart lttng-sessiond: its consumer has ended, and it starts no other one. `kill " +
                          std::to_string(daemon) + "` ends it with all its sessions; the next trace starts a new one"));
  }
}

TEST_F(DaemonFaults, WhatARecordingNeedsIsWatched) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> told;
  const auto next = [&] {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, std::chrono::seconds(30), [&] { return !told.empty(); });
    std::string sentence = told.empty() ? "nothing" : told.front();
    if (!told.empty()) {
      told.erase(told.begin());
    }
    return sentence;
  };
  std::unique_ptr<tracing::RunWatch> watch = tracer->watch(config(), [&](const std::string& sentence) {
    const std::lock_guard lock(mutex);
    told.push_back(sentence);
    changed.notify_one();
  });
  const pid_t daemon = tracing::session_daemon_pid();
  const pid_t consumer = processes("lttng-consumerd").at(0);
  kill(daemon, SIGSTOP);
  EXPECT_EQ(next(), "the LTTng session daemon (process " + std::to_string(daemon) +
                        ") is stopped: processes that start now are not recorded; continue it with `kill -CONT " +
                        std::to_string(daemon) + "`");
  kill(daemon, SIGCONT);
  kill(consumer, SIGSTOP);
  EXPECT_EQ(next(), "LTTng's consumer (process " + std::to_string(consumer) +
                        ") is stopped: events are lost when the buffers are full; continue it with `kill -CONT " +
                        std::to_string(consumer) + "`");
  kill(consumer, SIGKILL);
  EXPECT_EQ(next(), "LTTng's consumer (process " + std::to_string(consumer) +
                        ") has ended: nothing is written any more, and the trace ends here; the next trace starts "
                        "another one");
  kill(daemon, SIGKILL);
  EXPECT_EQ(next(), "the LTTng session daemon (process " + std::to_string(daemon) +
                        ") has ended: nothing is recorded any more, and the trace ends here; the system goes on");
  watch.reset();
  EXPECT_TRUE(told.empty()) << "each is said once";
  EXPECT_THAT(error_of([this] { tracer->finish(config(), never); }), HasSubstr("run"));
  EXPECT_THAT(test_support::read_file(fs::path(config().trace_directory()) / "verdict.json"),
              HasSubstr("\"complete\": false"));
}

TEST_F(DaemonFaults, AStoppedConsumerIsAnErrorAndIsContinuedAtTheEnd) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  TracedApp app(10, 10);
  const std::string consumer = std::to_string(processes("lttng-consumerd").at(0));
  for (const pid_t process : processes("lttng-consumerd")) {
    kill(process, SIGSTOP);
    while (launch::read_process_stat(process).state != 'T') {  // its threads stop one after the other
      std::this_thread::yield();
    }
  }
  const std::string stopped = "LTTng's consumer (process " + consumer + ") is stopped and does not answer\n" +
                              "continue it with `kill -CONT " + consumer + "`";
  EXPECT_EQ(error_of([this] { tracer->status("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->pause("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->resume("run"); }), stopped);
  const LossAccount losses = tracer->finish(config(), never);
  EXPECT_TRUE(losses.complete()) << losses.damage;
  EXPECT_THAT(losses.notes, testing::Contains("LTTng's consumer (process " + consumer +
                                              ") was stopped; it was continued, so that the session could end"));
  EXPECT_EQ(listed_sessions(), "");
  app.end();
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

TEST_F(DaemonFaults, StoppedProcessesThatMakeFilesAreContinuedAtTheEnd) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  tracer->start(config());
  TracedApp(10, 10).end();
  const std::vector<pid_t> makers = tracing::file_makers_of(processes("lttng-consumerd").at(0));
  ASSERT_THAT(makers, testing::SizeIs(1));
  kill(makers[0], SIGSTOP);
  while (launch::read_process_stat(makers[0]).state != 'T') {
    std::this_thread::yield();
  }
  const LossAccount losses = tracer->finish(config(), never);
  EXPECT_TRUE(losses.complete()) << losses.damage;
  EXPECT_THAT(losses.notes, testing::ElementsAre("a process that makes files for LTTng's daemons (process " +
                                                 std::to_string(makers[0]) +
                                                 ") was stopped; it was continued, so that the session could end"));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(DaemonFaults, ADaemonThatIsStoppedInMidRunIsAnErrorAndIsContinuedAtTheEnd) {
  tracer->start(config());
  TracedApp app(10, 10);
  const std::string home = std::string(getenv("LTTNG_HOME")) + "/.lttng";
  const pid_t pid = std::stoi(test_support::read_file((geteuid() == 0 ? "/run/lttng" : home) + "/lttng-sessiond.pid"));
  kill(pid, SIGSTOP);
  ASSERT_EQ(waitpid(pid, nullptr, WUNTRACED), pid);
  const std::string stopped = "the LTTng session daemon (process " + std::to_string(pid) +
                              ") is stopped and does not answer\ncontinue it with `kill -CONT " + std::to_string(pid) +
                              "`";
  EXPECT_EQ(error_of([this] { tracer->status("run"); }), stopped);
  EXPECT_EQ(error_of([this] { tracer->pause("run"); }), stopped);
  const LossAccount losses = tracer->finish(config(), never);
  EXPECT_TRUE(losses.complete()) << losses.damage;
  EXPECT_THAT(losses.notes, testing::ElementsAre("LTTng's session daemon (process " + std::to_string(pid) +
                                                 ") was stopped; it was continued, so that the session could end"));
  EXPECT_EQ(listed_sessions(), "");
  app.end();
  EXPECT_EQ(read_trace(config().trace_directory()).events.at("ros2:rclcpp_callback_register"), 10);
}

// Also in the middle of the end of a session.
TEST_F(DaemonFaults, DaemonsThatAreStoppedWhileTheSessionEndsAreContinued) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the consumers of the machine can't be told apart";
  }
  for (const char* const name : {"lttng-sessiond", "lttng-consumerd"}) {
    tracer->start(config(name));
    TracedApp app(2000, 200);
    const pid_t pid = processes(name).at(0);
    std::atomic<bool> ended = false;
    std::thread stopping([&] {
      while (!ended) {
        kill(pid, SIGSTOP);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
      }
    });
    const LossAccount losses = tracer->finish(config(name), never);
    ended = true;
    stopping.join();
    kill(pid, SIGCONT);
    EXPECT_TRUE(losses.complete()) << losses.damage;
    EXPECT_EQ(losses.notes.size(), 1u) << name;
    EXPECT_EQ(listed_sessions(), "");
    app.end();
  }
}

}  // namespace
}  // namespace trace_test
