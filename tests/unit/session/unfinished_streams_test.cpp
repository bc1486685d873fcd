// SPDX-License-Identifier: Apache-2.0
// Streams whose last packet is never completed, because a program dies, or is interrupted, within an event.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/monotonic_clock.hpp"
#include "tests/support/command.hpp"
#include "tests/unit/session/lttng_tracer_fixture.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/flight_recorder.hpp"
#include "tracing/record/session/snapshot.hpp"

namespace {

using test_support::run_command;
using test_support::RunningCommand;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using trace_test::never;
using trace_test::read_trace;
using tracing::LossAccount;
using tracing::TraceConfig;

constexpr const char* kUnfinished =
    "^unfinished: a thread did not complete its event, processor [0-9]+, since [0-9.]+ s of [0-9.]+ s \\(channel "
    "ros2\\)$";

struct UnfinishedStreams : trace_test::LttngTracer {
  void SetUp() override { setenv("LTTNG_UST_REGISTER_TIMEOUT", "-1", 1); }
  void TearDown() override { unsetenv("LTTNG_UST_REGISTER_TIMEOUT"); }

  static void die_within_an_event() { EXPECT_EQ(run_command({INTERRUPTED_APP, "20", "die"}).signal, SIGKILL); }

  static nlohmann::json verdict_in(const std::filesystem::path& directory) {
    return nlohmann::json::parse(test_support::read_file(directory / "verdict.json"));
  }
};

TEST_F(UnfinishedStreams, AreSaidWhereAProgramDiesWithinAnEvent) {
  for (const bool overwrite : {false, true}) {
    TraceConfig config = config_named(overwrite ? "overwrite" : "discard");
    config.overwrite_ust = overwrite;
    tracer->start(config);
    die_within_an_event();
    const LossAccount losses = tracer->finish(config, never);
    EXPECT_FALSE(losses.complete());
    EXPECT_TRUE(losses.has_losses());
    EXPECT_THAT(losses.damage, ContainsRegex(kUnfinished));
    EXPECT_EQ(verdict_in(config.trace_directory())["complete"], false);
    EXPECT_EQ(trace_test::listed_sessions(), "");
  }
}

TEST_F(UnfinishedStreams, OfAProcessWithBuffersOfItsOwnAreSaid) {
  TraceConfig config = config_named("run");
  config.buffers_ust = tracing::BufferOwner::kProcess;
  tracer->start(config);
  trace_test::TracedApp other(10, 10);
  die_within_an_event();
  other.end();
  const LossAccount losses = tracer->finish(config, never);
  // The streams of its other processors end with the process; they tell more only if there are some.
  EXPECT_FALSE(losses.complete());
}

TEST_F(UnfinishedStreams, OfASnapshotAreSaid) {
  TraceConfig config = config_named("run");
  config.snapshot_mode = true;
  tracer->start(config);
  die_within_an_event();
  const std::string directory = tracer->record_snapshot("run");
  tracer->finish(config, never);
  const nlohmann::json verdict = verdict_in(directory);
  EXPECT_EQ(verdict["complete"], false);
  EXPECT_THAT(verdict["damage"].get<std::string>(), ContainsRegex(kUnfinished));
  EXPECT_EQ(verdict["unwritten"].size(), 1u) << verdict.dump(2);
}

// LTTng throws the buffers of a process away when it ends. This program does not count its events.
TEST_F(UnfinishedStreams, OfASnapshotWithoutTheDeadProcessAreSaid) {
  TraceConfig config = config_named("run");
  config.snapshot_mode = true;
  config.buffers_ust = tracing::BufferOwner::kProcess;
  tracer->start(config);
  trace_test::TracedApp(10, 10).end();
  const nlohmann::json verdict = verdict_in(tracer->record_snapshot("run"));
  tracer->finish(config, never);
  EXPECT_EQ(verdict["complete"], false) << verdict.dump(2);
  EXPECT_EQ(verdict["absent"].size(), 1u);
}

TEST_F(UnfinishedStreams, OfAPausedSessionAreSaid) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  die_within_an_event();
  const auto losses = tracer->pause("run");
  ASSERT_TRUE(losses);
  EXPECT_THAT(losses->damage, ContainsRegex(kUnfinished));
  EXPECT_FALSE(tracer->finish(config, never).complete());
}

// A thread that another one has pushed aside within an event goes on when it gets a processor again.
TEST_F(UnfinishedStreams, AreWaitedForWhileTheThreadMayGoOn) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  RunningCommand app({.argv = {INTERRUPTED_APP, "20", "wait"}, .environment = {}});
  ASSERT_TRUE(app.wait_for_output("within\n"));
  bool asked = false;
  const LossAccount losses = tracer->finish(config, [&app, &asked] {
    if (!std::exchange(asked, true)) {
      app.write("\n");
    }
    return false;
  });
  EXPECT_EQ(losses.damage, "");
  EXPECT_TRUE(losses.complete());
  app.wait();
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rclcpp_take"], 21);
}

// The timer has ended the last packet, and the consumer has read none: LTTng adds no packet where there is no room, and
// what was lost since would be in no total.
TEST_F(UnfinishedStreams, WithFullBuffersTellWhatWasLostToTheEnd) {
  for (const bool pauses : {false, true}) {
    TraceConfig config = config_named(pauses ? "paused" : "run");
    config.ust = {.subbuffer_size = 4096, .subbuffer_count = 2, .read_timer = 1'000'000};
    config.switch_timer_ust = 1000;
    tracer->start(config);
    trace_test::TracedApp app(300, 10);
    std::uint64_t fired = 301;
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    while (std::chrono::steady_clock::now() < until) {
      app.fire_again();
      fired += 300;
    }
    std::uint64_t discarded = 0;
    if (pauses) {
      const auto paused = tracer->pause(config.session_name);
      ASSERT_TRUE(paused);
      discarded = paused->discarded_events();
    }
    const LossAccount losses = tracer->finish(config, never);
    app.end();
    const trace_test::ReadTrace read = read_trace(config.trace_directory());
    std::uint64_t recorded = 0;
    for (const auto& [name, count] : read.events) {
      recorded += static_cast<std::uint64_t>(count);
    }
    EXPECT_EQ(losses.discarded_events(), fired - recorded);
    EXPECT_EQ(discarded, pauses ? fired - recorded : 0);
    EXPECT_FALSE(losses.complete());
  }
}

// What the watch of the run says within so long of the death of a process.
class Watched {
 public:
  Watched(tracing::Tracer& tracer, const TraceConfig& config)
      : watch_(tracer.watch(config, [this](const std::string& sentence) {
          const std::lock_guard lock(mutex_);
          said_.push_back(sentence);
          changed_.notify_one();
        })) {}

  void ended(const std::string& process) { watch_->process_ended(process); }
  std::vector<std::string> said_within(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return !said_.empty(); });
    return std::exchange(said_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> said_;
  std::unique_ptr<tracing::RunWatch> watch_;
};

constexpr std::chrono::milliseconds kASecond{1000};
constexpr std::chrono::milliseconds kASecondOnABusyMachine{4000};

TEST_F(UnfinishedStreams, AreSaidWhileTheSessionRecords) {
  for (const bool snapshots : {false, true}) {
    TraceConfig config = config_named(snapshots ? "snapshots" : "run");
    config.snapshot_mode = snapshots;
    tracer->start(config);
    trace_test::TracedApp other(10, 10);
    Watched watched(*tracer, config);
    die_within_an_event();
    watched.ended("planner-1");
    EXPECT_THAT(
        watched.said_within(kASecondOnABusyMachine),
        ElementsAre(ContainsRegex("^planner-1 died within an event: what processor [0-9]+ records is lost since "
                                  "[0-9.]+ s before, also of other processes; start the launch anew")));
    EXPECT_EQ(tracer->status(config.session_name).held_up.size(), 1u);
    watched.ended("another");
    EXPECT_THAT(watched.said_within(kASecond), IsEmpty()) << "it is said once";
    other.end();
    tracer->finish(config, never);
  }
}

// Another session of the same session daemon is held up.
TEST_F(UnfinishedStreams, AreNotSaidOfAnotherSession) {
  const TraceConfig held_up = config_named("other");
  tracer->start(held_up);
  die_within_an_event();
  const TraceConfig config = config_named("run");
  tracer->start(config);
  trace_test::TracedApp app(10, 10);
  Watched watched(*tracer, config);
  watched.ended("planner-1");
  EXPECT_THAT(watched.said_within(kASecond + kASecond), IsEmpty());
  EXPECT_TRUE(tracer->status("run").held_up.empty());
  EXPECT_EQ(tracer->status("other").held_up.size(), 1u);
  app.end();
  tracer->finish(held_up, never);
  tracer->finish(config, never);
}

TEST_F(UnfinishedStreams, AreNotSaidWhereEachProcessHasBuffersOfItsOwn) {
  TraceConfig config = config_named("run");
  config.buffers_ust = tracing::BufferOwner::kProcess;
  tracer->start(config);
  Watched watched(*tracer, config);
  die_within_an_event();
  watched.ended("planner-1");
  EXPECT_THAT(watched.said_within(kASecond + kASecond), IsEmpty());
  EXPECT_TRUE(tracer->status("run").held_up.empty());
  tracer->finish(config, never);
}

// A thread that is stopped within an event, and goes on when it has been taken for dead.
TEST_F(UnfinishedStreams, AreTakenBackWhenTheyGoOn) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  RunningCommand app({.argv = {INTERRUPTED_APP, "20", "wait"}, .environment = {}});
  ASSERT_TRUE(app.wait_for_output("within\n"));
  Watched watched(*tracer, config);
  watched.ended("planner-1");
  EXPECT_THAT(watched.said_within(kASecondOnABusyMachine), ElementsAre(HasSubstr("planner-1 died within an event")));
  app.write("\n");
  app.wait();
  EXPECT_THAT(watched.said_within(kASecondOnABusyMachine),
              ElementsAre(ContainsRegex("^the events of processor [0-9]+ are recorded after all")));
  EXPECT_TRUE(tracer->finish(config, never).complete());
}

TEST_F(UnfinishedStreams, AreNotSaidOfThreadsThatFireWithoutPause) {
  TraceConfig config = config_named("run");
  config.overwrite_ust = true;
  tracer->start(config);
  std::list<RunningCommand> apps;
  for (int i = 0; i < 4; ++i) {
    apps.emplace_back(test_support::Command{.argv = {INTERRUPTED_APP, "2000000000", "die"}, .environment = {}});
  }
  Watched watched(*tracer, config);
  for (int i = 0; i < 4; ++i) {
    watched.ended("planner-1");
    EXPECT_THAT(watched.said_within(kASecond), IsEmpty());
  }
  for (RunningCommand& app : apps) {
    app.send_signal(SIGKILL);
    app.wait();
  }
  tracer->finish(config, never);
}

// LTTng's rotation, and its end of a session that was rotated, wait for the packet that is never completed.
TEST_F(UnfinishedStreams, OfARotatedSessionAreSaidAndTheSessionEnds) {
  tracing::set_longest_silence(std::chrono::milliseconds(1000));
  for (const bool dies_before : {true, false}) {
    const TraceConfig config = config_named(dies_before ? "before" : "after");
    tracer->start(config);
    trace_test::TracedApp(10, 10).end();
    if (dies_before) {
      die_within_an_event();
    }
    run_command({"lttng", "rotate", "--no-wait", config.session_name});
    if (!dies_before) {
      die_within_an_event();
    }
    const LossAccount losses = tracer->finish(config, never);
    EXPECT_FALSE(losses.complete());
    EXPECT_THAT(losses.damage, HasSubstr("unfinished: a thread did not complete its event"));
    EXPECT_EQ(losses.stuck, dies_before) << losses.damage;
    EXPECT_EQ(verdict_in(config.trace_directory())["complete"], false);
    EXPECT_EQ(trace_test::listed_sessions(), "");
  }
  tracing::set_longest_silence(tracing::kLongestSilence);
}

TEST_F(UnfinishedStreams, AreNotSaidOfIdleOnesThatWereRotated) {
  for (int i = 0; i < 6; ++i) {
    const TraceConfig config = config_named("run" + std::to_string(i));
    tracer->start(config);
    trace_test::TracedApp app(10, 10);
    EXPECT_EQ(run_command({"lttng", "rotate", config.session_name}).exit_code, 0);
    if (i % 2 == 0) {
      app.fire_again();
    }
    const LossAccount losses = tracer->finish(config, never);
    EXPECT_TRUE(losses.complete()) << losses.damage;
    app.end();
  }
}

TEST_F(UnfinishedStreams, AreNotSaidOfIdleOnes) {
  for (int i = 0; i < 10; ++i) {
    TraceConfig config = config_named("run" + std::to_string(i));
    config.snapshot_mode = i % 2 == 1;
    tracer->start(config);
    trace_test::TracedApp app(10, 10);
    if (i % 4 < 2) {
      app.end();
    }
    if (config.snapshot_mode) {
      const nlohmann::json verdict = verdict_in(tracer->record_snapshot(config.session_name));
      EXPECT_EQ(verdict["complete"], true) << verdict.dump(2);
    }
    const LossAccount losses = tracer->finish(config, never);
    if (!config.snapshot_mode) {
      EXPECT_TRUE(losses.complete()) << losses.damage;
    }
    if (i % 4 >= 2) {
      app.end();
    }
  }
}

// Other machines take their snapshots a little later.
TEST_F(UnfinishedStreams, AreNotTakenForASnapshotThatBeginsAfterItsReason) {
  TraceConfig config = config_named("run");
  config.snapshot_mode = true;
  config.ust.subbuffer_size = 4096;
  config.ust.subbuffer_count = 2;
  tracer->start(config);
  const std::int64_t before = launch::monotonic_time();
  trace_test::TracedApp app(1000, 1000);
  for (const auto& [moment, is_held] :
       {std::pair(before, false), std::pair(launch::monotonic_time(), true), std::pair(std::int64_t{0}, true)}) {
    const tracing::TakenSnapshot taken = tracing::take_snapshot(config, {.reasons = {"late"}, .moment = moment});
    ASSERT_EQ(taken.error, "");
    EXPECT_EQ(taken.damage, "");
    const nlohmann::json verdict = verdict_in(taken.directory);
    EXPECT_EQ(verdict["complete"], is_held) << verdict.dump(2);
    if (!is_held) {
      EXPECT_THAT(verdict["absent"].dump(),
                  ContainsRegex("the snapshot begins 0[.][0-9]+ s after its reason: the buffers did "
                                "not hold more"));
    }
  }
  app.end();
  tracer->finish(config, never);
}

}  // namespace
