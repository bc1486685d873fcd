// SPDX-License-Identifier: Apache-2.0
// Traces that go to a relay daemon, and live sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/processes/process_stat.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/unit/session/listed_session.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/loss_text.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

namespace {

using test_support::run_command;
using trace_test::list_session;
using trace_test::read_trace;
using trace_test::TracedApp;
using tracing::TraceConfig;
using tracing::TraceError;

struct NetworkSession : testing::Test {
  TraceConfig config() const {
    TraceConfig made;
    made.session_name = "run";
    made.base_path = sandbox.trace_directory();
    made.url = "net://127.0.0.1";
    return made;
  }

  // Returns when the daemon answers. It ends with the sandbox, like all of LTTng's daemons.
  void start_relay_daemon() {
    ASSERT_EQ(run_command({"lttng-relayd", "--daemonize", "--output=" + relayed().string()}).exit_code, 0);
  }
  std::filesystem::path relayed() const { return sandbox.directory() / "relayed"; }

  // That of this test; all sandboxes share the numbers of processes.
  static void signal_relay_daemon(int number) { signal_daemon("lttng-relayd", number); }
  static void signal_daemon(const std::string& name, int number) {
    int signalled = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const pid_t pid = static_cast<pid_t>(std::strtol(entry.path().filename().c_str(), nullptr, 10));
      if (pid <= 0 || launch::read_process_stat(pid).name != name) {
        continue;
      }
      std::error_code gone;
      const auto network = std::filesystem::read_symlink(entry.path() / "ns/net", gone);
      if (gone || network != std::filesystem::read_symlink("/proc/self/ns/net")) {
        continue;
      }
      kill(pid, number);
      ++signalled;
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
      while (number == SIGSTOP && launch::read_process_stat(pid).state != 'T') {
        if (std::chrono::steady_clock::now() > until) {
          FAIL() << "it does not stop";
        }
        std::this_thread::yield();
      }
    }
    EXPECT_EQ(signalled, 1);
  }

  test_support::Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();
};

TEST_F(NetworkSession, TheTraceArrivesAtTheRelayDaemon) {
  start_relay_daemon();
  EXPECT_EQ(tracer->start(config()).trace_directory, "net://127.0.0.1");
  TracedApp(25, 10).end();
  const tracing::LossAccount losses = tracer->finish(config(), [] { return false; });
  EXPECT_TRUE(losses.complete());
  EXPECT_EQ(losses.unwritten_verdict, "") << "there is no directory of ours that could hold it";
  EXPECT_EQ(read_trace(relayed()).events.at("ros2:rclcpp_callback_register"), 25);
  EXPECT_FALSE(std::filesystem::exists(sandbox.trace_directory() / "run"));
}

TEST_F(NetworkSession, ALiveSessionHasItsTimerAndIsRelayed) {
  start_relay_daemon();
  TraceConfig live = config();
  live.url.clear();
  live.live_timer = 100'000;
  tracer->start(live);
  EXPECT_EQ(list_session("run").live_timer, 100'000u);
  TracedApp(25, 10).end();
  tracer->finish(live, [] { return false; });
  EXPECT_EQ(read_trace(relayed()).events.at("ros2:rclcpp_callback_register"), 25);
}

TEST_F(NetworkSession, TheRelayDaemonIsWatched) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the daemons of the machine can't be told apart";
  }
  start_relay_daemon();
  tracer->start(config());
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> told;
  const auto next = [&] {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, std::chrono::seconds(60), [&] { return !told.empty(); });
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
  TracedApp app(25, 10);
  signal_relay_daemon(SIGSTOP);
  EXPECT_EQ(next(),
            "the relay daemon at net://127.0.0.1 takes no data: events are lost when the buffers are full; see whether "
            "it is stopped");
  signal_relay_daemon(SIGKILL);
  EXPECT_EQ(next(),
            "the relay daemon at net://127.0.0.1 is gone: the trace there ends here, and what is recorded from now on "
            "is lost; the system goes on");
  watch.reset();
  EXPECT_TRUE(told.empty()) << "each is said once";
  app.end();
  const tracing::LossAccount losses = tracer->finish(config(), [] { return false; });
  EXPECT_FALSE(losses.complete());
  EXPECT_TRUE(losses.has_losses());
  EXPECT_THAT(tracing::describe_losses(losses),
              testing::AnyOf(testing::HasSubstr("the relay daemon was gone before the session ended: what was recorded "
                                                "since then is lost"),
                             testing::HasSubstr("LTTng's consumer daemon and its connection to the relay daemon ended "
                                                "before the session: what was recorded since then is lost")));
  EXPECT_EQ(trace_test::listed_sessions(), "");
}

// With LTTng 2.13.15 it happened now and then.
TEST_F(NetworkSession, AConsumerThatEndsWithTheRelayDaemonIsALoss) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the daemons of the machine can't be told apart";
  }
  start_relay_daemon();
  tracer->start(config());
  TracedApp(25, 10).end();
  signal_relay_daemon(SIGKILL);
  signal_daemon("lttng-consumerd", SIGKILL);
  signal(SIGPIPE, SIG_IGN);  // as launch does; LTTng's library writes to a daemon that may have ended
  try {
    const tracing::LossAccount losses = tracer->finish(config(), [] { return false; });
    EXPECT_TRUE(losses.has_losses());
    EXPECT_THAT(tracing::describe_losses(losses),
                testing::HasSubstr("LTTng's consumer daemon and its connection to the relay daemon ended before the "
                                   "session: what was recorded since then is lost, and LTTng does not tell how much"));
    EXPECT_EQ(trace_test::listed_sessions(), "");
  } catch (const TraceError& error) {
    // Sometimes LTTng's session daemon ends with its consumer.
    EXPECT_THAT(error.what(), testing::HasSubstr("No session daemon is available"));
  }
}

// Calls of LTTng's would never return.
TEST_F(NetworkSession, AStoppedRelayDaemonIsAnErrorAndIsContinuedAtTheEnd) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the daemons of the machine can't be told apart";
  }
  start_relay_daemon();
  tracer->start(config());
  TracedApp(25, 10).end();
  signal_relay_daemon(SIGSTOP);
  try {
    tracer->pause("run");
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(), "the relay daemon that gets the trace of session 'run' is stopped");
    EXPECT_EQ(error.remedy(),
              "continue it with `kill -CONT` and its process id, then end the session with `launch trace stop run`");
  }
  const tracing::LossAccount losses = tracer->finish(config(), [] { return false; });
  EXPECT_TRUE(losses.complete());
  EXPECT_THAT(losses.notes, testing::ElementsAre(testing::MatchesRegex(
                                "the relay daemon \\(process [0-9]+\\) was stopped; it was continued, so that the "
                                "session could end")));
  EXPECT_EQ(read_trace(relayed()).events.at("ros2:rclcpp_callback_register"), 25);
}

// The session daemon connects to it for a new session, and waits.
TEST_F(NetworkSession, ARelayDaemonThatIsStoppedBeforeTheStartIsNamed) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "skipped, because without root the daemons of the machine can't be told apart";
  }
  start_relay_daemon();
  ASSERT_EQ(run_command({"lttng-sessiond", "--daemonize"}).exit_code, 0);
  signal_relay_daemon(SIGSTOP);
  tracing::set_longest_silence(std::chrono::milliseconds(1000));
  try {
    tracer->start(config());
    ADD_FAILURE() << "no error";
  } catch (const TraceError& error) {
    EXPECT_THAT(error.what(), testing::EndsWith(": LTTng does not answer, it was waited for 10 s"));
    EXPECT_THAT(error.remedy(),
                testing::MatchesRegex("the relay daemon is stopped: continue it with `kill -CONT [0-9]+`"));
  }
  tracing::set_longest_silence(tracing::kLongestSilence);
  EXPECT_EQ(trace_test::listed_sessions(), "");
}

TEST_F(NetworkSession, SnapshotsAreRelayed) {
  start_relay_daemon();
  TraceConfig snapshots = config();
  snapshots.snapshot_mode = true;
  tracer->start(snapshots);
  TracedApp app(25, 10);
  tracer->record_snapshot("run");
  tracer->finish(snapshots, [] { return false; });
  app.end();
  EXPECT_EQ(read_trace(relayed()).events.at("ros2:rclcpp_callback_register"), 25);
}

TEST_F(NetworkSession, WithoutARelayDaemonItIsAnErrorThatSaysSo) {
  try {
    tracer->start(config());
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(error.what(), "cannot create ust channel 'ros2': Unable to connect to lttng-relayd");
    EXPECT_EQ(error.remedy(), "start a relay daemon there: lttng-relayd --daemonize");
  }
  EXPECT_EQ(trace_test::listed_sessions(), "");
}

}  // namespace
