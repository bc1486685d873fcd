// SPDX-License-Identifier: Apache-2.0
// The real tracer on a session daemon of the test's own.
#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/unit/session/lttng_tracer_fixture.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_details.hpp"
#include "tracing/record/session/tracer.hpp"

namespace {

using test_support::read_file;
using test_support::run_command;
using testing::IsEmpty;
using trace_test::listed_sessions;
using trace_test::LttngTracer;
using trace_test::never;
using trace_test::read_trace;
using trace_test::ReadTrace;
using trace_test::TracedApp;
using tracing::LossAccount;
using tracing::SessionStep;
using tracing::SetupReport;
using tracing::TraceConfig;
using tracing::TraceError;

std::vector<std::string> step_names(const SetupReport& report) {
  std::vector<std::string> names;
  for (const SessionStep& step : report.steps) {
    names.push_back(step.name);
  }
  return names;
}

TEST_F(LttngTracer, RecordsEveryEventOfTwoApplications) {
  const TraceConfig config = config_named("run");
  const SetupReport report = tracer->start(config);
  EXPECT_EQ(report.trace_directory, config.trace_directory());
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_THAT(step_names(report),
              testing::ElementsAre("checks", "session daemon", "create session", "channel ros2", "events ros2",
                                   "context fields ros2", "start", "consumer priority"));
  TracedApp first(60, 100);
  TracedApp second(60, 100);
  first.end();
  const LossAccount losses = tracer->finish(config, never);
  second.end();

  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_EQ(losses.discarded_events(), 0u);
  EXPECT_EQ(trace.events, (std::map<std::string, int>{{"ros2:rcl_init", 2}, {"ros2:rclcpp_callback_register", 120}}));
  EXPECT_THAT(read_file(config.trace_directory() + "/verdict.json"), testing::HasSubstr("\"complete\": true"));
  EXPECT_GT(losses.channels.at(0).bytes, 120 * 100u) << "the packets were found";
  EXPECT_THAT(trace.lines.at(0), testing::HasSubstr("procname = \"traced_app\""));
  EXPECT_THAT(trace.lines.at(0), testing::ContainsRegex("vpid = [0-9]+, vtid = [0-9]+"));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, StartsADaemonOnDemandOnce) {
  EXPECT_TRUE(tracer->start(config_named("first")).started_daemon);
  EXPECT_FALSE(tracer->start(config_named("second")).started_daemon);
  tracer->finish(config_named("first"), never);
  tracer->finish(config_named("second"), never);
  EXPECT_EQ(listed_sessions(), "");
}

// LTTng's library has one connection for the whole process, which two threads must not use at once.
TEST_F(LttngTracer, ThreadsThatAskTheSessionDaemonAtOnceGetTheirOwnAnswers) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  constexpr int kQuestions = 500;
  std::atomic<int> sessions = 0;
  std::atomic<int> domains = 0;
  const auto ask_often = [](std::atomic<int>& total, auto&& question) {
    return [&total, question] {
      for (int i = 0; i < kQuestions; ++i) {
        total += question();
      }
    };
  };
  const auto ask_for_sessions = [] {
    lttng_session* listed = nullptr;
    const int count = tracing::lttng_list_sessions(&listed);
    std::free(listed);
    return count;
  };
  const auto ask_for_domains = [] {
    lttng_domain* listed = nullptr;
    const int count = tracing::lttng_list_domains("run", &listed);
    std::free(listed);
    return count;
  };
  testing::internal::CaptureStderr();
  {
    std::jthread first(ask_often(sessions, ask_for_sessions));
    std::jthread second(ask_often(domains, ask_for_domains));
    std::jthread third(ask_often(sessions, ask_for_sessions));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(sessions, 2 * kQuestions);
  EXPECT_EQ(domains, kQuestions);
  tracer->finish(config, never);
}

TEST_F(LttngTracer, TraceIsCompleteOnDiskEveryTimeFinishReturns) {
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    const TraceConfig config = config_named("run" + std::to_string(run));
    tracer->start(config);
    TracedApp alive(20, 50);
    TracedApp ended(20, 50);
    ended.end();
    tracer->finish(config, never);
    const ReadTrace trace = read_trace(config.trace_directory());
    ASSERT_EQ(trace.complaints, "") << "run " << run;
    ASSERT_EQ(trace.events, (std::map<std::string, int>{{"ros2:rcl_init", 2}, {"ros2:rclcpp_callback_register", 40}}))
        << "run " << run;
    alive.end();
  }
  EXPECT_EQ(listed_sessions(), "");
}

// LTTng moves the last part of a rotated session some time after it has destroyed the session.
TEST_F(LttngTracer, RotatedTraceStaysWhereItIsOnceFinishHasReturned) {
  const auto directories_of = [](const std::string& trace) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(trace)) {
      if (entry.is_directory()) {
        names.push_back(entry.path().filename());
      }
    }
    return names;
  };
  constexpr int kRuns = 5;
  for (int run = 0; run < kRuns; ++run) {
    const TraceConfig config = config_named("run" + std::to_string(run));
    tracer->start(config);
    TracedApp app(20, 50);
    const auto rotated = run_command({"lttng", "rotate", config.session_name});
    ASSERT_EQ(rotated.exit_code, 0) << rotated.err;
    app.fire_again();
    app.end();
    tracer->finish(config, never);
    EXPECT_EQ(directories_of(config.trace_directory()), std::vector<std::string>{"archives"}) << "run " << run;
    const ReadTrace trace = read_trace(config.trace_directory());
    ASSERT_EQ(trace.complaints, "") << "run " << run;
    ASSERT_EQ(trace.events, (std::map<std::string, int>{{"ros2:rcl_init", 1}, {"ros2:rclcpp_callback_register", 40}}))
        << "run " << run;
  }
}

TEST_F(LttngTracer, AppendedTraceIsReadTogetherWithTheEarlierOnes) {
  TraceConfig config = config_named("again");
  config.append_trace = true;
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(tracer->start(config).trace_directory, config.trace_directory());
    TracedApp(5, 10).end();
    tracer->finish(config, never);
  }
  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_EQ(trace.events.at("ros2:rcl_init"), 3);
}

TEST_F(LttngTracer, OddSubbufferSizesAreRoundedUpWithAWarning) {
  TraceConfig config = config_named("run");
  config.ust.subbuffer_size = 10000;
  EXPECT_THAT(tracer->start(config).warnings,
              testing::ElementsAre("sub-buffer size of 10000 bytes for the ust domain is rounded up to 16384: LTTng "
                                   "needs a power of two, at least a page"));
  EXPECT_THAT(run_command({"lttng", "list", "run"}).out, testing::HasSubstr("Sub-buffer size:  16384 bytes"));
  tracer->finish(config, never);
}

TEST_F(LttngTracer, ChannelHasTheAttributesOfRos2TracingButForItsBuffers) {
  tracer->start(config_named("run"));
  const std::string listing = run_command({"lttng", "list", "run"}).out;
  for (const char* expected : {"Buffering scheme: per-user", "- ros2: [enabled]", "Event-loss mode:  discard",
                               "Sub-buffer size:  1048576 bytes", "Sub-buffer count: 4", "Switch timer:     5000000 us",
                               "Read timer:       50000 us", "Output mode:      mmap"}) {
    EXPECT_THAT(listing, testing::HasSubstr(expected));
  }
  tracer->finish(config_named("run"), never);
}

TEST_F(LttngTracer, ChannelHasTheNumberAndTimersThatWereAskedFor) {
  TraceConfig config = config_named("run");
  config.ust.subbuffer_count = 7;
  config.ust.read_timer = 50'000;
  config.switch_timer_ust = 1'000'000;
  EXPECT_THAT(
      tracer->start(config).warnings,
      testing::ElementsAre("number of sub-buffers 7 is rounded up to 8: LTTng needs a power of two, at least 2"));
  const std::string listing = run_command({"lttng", "list", "run"}).out;
  for (const char* expected : {"Sub-buffer count: 8", "Switch timer:     1000000 us", "Read timer:       50000 us"}) {
    EXPECT_THAT(listing, testing::HasSubstr(expected));
  }
  tracer->finish(config, never);
}

TEST_F(LttngTracer, InitialisationEventsHaveAChannelOfTheirOwnWhereAskedFor) {
  TraceConfig config = config_named("run");
  config.events_ust = {"ros2:*", "my:event"};
  config.init_channel = true;
  tracer->start(config);
  TracedApp(30, 10).end();
  const std::vector<tracing::ChannelDetails> channels = tracer->status("run").channels;
  ASSERT_EQ(channels.size(), 2u);
  for (const tracing::ChannelDetails& channel : channels) {
    const bool initialisation = channel.name == "ros2_init";
    EXPECT_EQ(channel.events.size(), initialisation ? 22u : 21u) << channel.name;
    EXPECT_THAT(channel.events, testing::Contains(initialisation ? "ros2:rcl_init" : "ros2:callback_start"));
  }
  const LossAccount losses = tracer->finish(config, never);
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rclcpp_callback_register"], 30) << "each once";
  ASSERT_EQ(losses.channels.size(), 2u);
  const auto bytes = [&losses](const std::string& name) {
    return losses.channels.at(losses.channels.at(0).channel == name ? 0 : 1).bytes;
  };
  EXPECT_GT(bytes("ros2_init"), bytes("ros2") + 30 * 30) << "they are not in the other one";
}

TEST_F(LttngTracer, LossesEqualWhatTheTraceSays) {
  TraceConfig config = config_named("flood");
  config.ust.subbuffer_size = 4096;
  tracer->start(config);
  constexpr int kEvents = 200000;
  TracedApp flood(kEvents, 200);
  flood.end();
  const LossAccount losses = tracer->finish(config, never);
  const ReadTrace trace = read_trace(config.trace_directory());
  EXPECT_EQ(trace.complaints, "");
  EXPECT_GT(losses.discarded_events(), 0u);
  EXPECT_EQ(losses.discarded_events(), trace.discarded);
  EXPECT_EQ(losses.discarded_events() + trace.lines.size(), static_cast<std::uint64_t>(kEvents) + 1);

  const std::string verdict = read_file(config.trace_directory() + "/verdict.json");
  EXPECT_THAT(verdict, testing::HasSubstr("\"complete\": false"));
  EXPECT_THAT(verdict, testing::HasSubstr("\"discarded_events\": " + std::to_string(trace.discarded)));
  std::uint64_t in_ranges = 0;
  for (const tracing::LossRange& range : losses.channels.at(0).ranges) {
    in_ranges += range.events;
  }
  EXPECT_EQ(in_ranges, trace.discarded);
}

TEST_F(LttngTracer, GivingUpDestroysTheSessionAtOnce) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  TracedApp app(10, 10);
  tracer->finish(config, [] { return true; });
  app.end();
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, PausedSessionRecordsNothingUntilItIsResumed) {
  const TraceConfig config = config_named("run");
  tracer->start(config);
  TracedApp app(10, 10);
  tracer->pause("run");
  app.fire_again();
  tracer->resume("run");
  app.fire_again();
  tracer->pause("run");
  tracer->finish(config, never);
  app.end();
  EXPECT_EQ(read_trace(config.trace_directory()).events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, SnapshotsHoldWhatCameSinceTheLastOne) {
  TraceConfig config = config_named("run");
  config.snapshot_mode = true;
  tracer->start(config);
  EXPECT_THAT(
      run_command({"lttng", "list", "run"}).out,
      testing::AllOf(testing::HasSubstr("Event-loss mode:  overwrite"), testing::HasSubstr("Sub-buffer count: 4")));
  TracedApp app(10, 10);
  EXPECT_FALSE(std::filesystem::exists(config.trace_directory()));
  tracer->record_snapshot("run");
  app.fire_again();
  app.fire_again();
  tracer->record_snapshot("run");
  tracer->finish(config, never);
  app.end();

  std::vector<int> counts;
  for (const auto& snapshot : std::filesystem::directory_iterator(config.trace_directory())) {
    counts.push_back(read_trace(snapshot.path()).events["ros2:rclcpp_callback_register"]);
  }
  EXPECT_THAT(counts, testing::UnorderedElementsAre(10, 20));
  EXPECT_EQ(listed_sessions(), "");
}

TEST_F(LttngTracer, SnapshotOfAnOrdinarySessionIsAnError) {
  tracer->start(config_named("run"));
  try {
    tracer->record_snapshot("run");
    FAIL() << "no error";
  } catch (const TraceError& error) {
    EXPECT_STREQ(
        error.what(),
        "cannot record a snapshot of session 'run': Snapshot command can't be applied to a non-snapshot session");
  }
  tracer->finish(config_named("run"), never);
}

TEST_F(LttngTracer, DualSessionKeepsTheInitialisationOfNodesThatRanBefore) {
  TraceConfig snapshot = config_named("dual");
  snapshot.dual_session = true;
  snapshot.events_ust = tracing::initialisation_ros_events();
  tracer->start(snapshot);
  TracedApp app(10, 10);

  TraceConfig runtime = config_named("dual");
  runtime.dual_runtime = true;
  tracer->record_snapshot("dual-snapshot");
  tracer->start(runtime);
  app.fire_again();
  tracer->finish(runtime, never);
  tracer->finish(snapshot, never);
  app.end();

  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual" / "snapshot").events["ros2:rcl_init"], 1);
  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual" / "runtime").events["ros2:rclcpp_callback_register"], 10);
  EXPECT_EQ(read_trace(sandbox.trace_directory() / "dual").events["ros2:rclcpp_callback_register"], 20);
  EXPECT_EQ(listed_sessions(), "");
}

}  // namespace
