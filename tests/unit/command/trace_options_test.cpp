// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/trace_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tracing/record/plan/trace_config.hpp"

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tracing::parse_trace_options;
using tracing::ParserMessage;
using tracing::TraceOptions;
using tracing::TraceVerb;

TraceOptions options_of(const std::vector<std::string>& arguments) {
  const auto parsed = parse_trace_options(arguments);
  if (const auto* message = std::get_if<ParserMessage>(&parsed)) {
    ADD_FAILURE() << message->text;
  }
  return std::holds_alternative<TraceOptions>(parsed) ? std::get<TraceOptions>(parsed) : TraceOptions{};
}

ParserMessage message_of(const std::vector<std::string>& arguments) {
  const auto parsed = parse_trace_options(arguments);
  return std::holds_alternative<ParserMessage>(parsed) ? std::get<ParserMessage>(parsed) : ParserMessage{-1, "parsed"};
}

TEST(TraceOptions, WithoutArgumentsAreTheDefaultsOfTheInteractiveForm) {
  const TraceOptions options = options_of({});
  EXPECT_EQ(options.verb, TraceVerb::kInteractive);
  EXPECT_THAT(options.config.session_name, testing::MatchesRegex("session-[0-9]{14}"));
  EXPECT_EQ(options.config.events_ust, tracing::default_ros_events());
  EXPECT_THAT(options.config.context_fields_ust, ElementsAre("procname", "vpid", "vtid"));
  EXPECT_TRUE(std::filesystem::path(options.config.base_path).is_absolute());
  EXPECT_FALSE(options.list_names || options.dual_session);
}

TEST(TraceOptions, OfTheBuffersAndTheDestination) {
  const tracing::TraceConfig config =
      options_of({"start", "run", "--overwrite-ust", "true", "--blocking-timeout-ust", "-1", "--buffers-ust", "pid",
                  "--tracefile-size", "65536", "--tracefile-count", "3", "--url", "net://host", "--live-timer", "1000"})
          .config;
  EXPECT_EQ(config.overwrite_ust, true);
  EXPECT_EQ(config.ust.blocking_timeout, -1);
  EXPECT_EQ(config.buffers_ust, tracing::BufferOwner::kProcess);
  EXPECT_EQ(config.tracefile_size, 65536u);
  EXPECT_EQ(config.tracefile_count, 3u);
  EXPECT_EQ(config.url, "net://host");
  EXPECT_EQ(config.live_timer, 1000u);
  EXPECT_EQ(options_of({"start", "run"}).config.overwrite_ust, std::nullopt);
}

TEST(TraceOptions, AreAllTakenByTheInteractiveForm) {
  const TraceOptions options = options_of({"-s",
                                           "run",
                                           "-p",
                                           "/traces",
                                           "-u",
                                           "ros2:*",
                                           "my:event",
                                           "-k",
                                           "sched_switch",
                                           "--syscall",
                                           "openat",
                                           "close",
                                           "-c",
                                           "vpid",
                                           "-l",
                                           "-a",
                                           "--snapshot-mode",
                                           "--subbuffer-size-ust",
                                           "65536",
                                           "--subbuffer-size-kernel",
                                           "262144"});
  EXPECT_EQ(options.config.session_name, "run");
  EXPECT_EQ(options.config.base_path, "/traces");
  EXPECT_THAT(options.config.events_ust, ElementsAre("ros2:*", "my:event"));
  EXPECT_THAT(options.config.events_kernel, ElementsAre("sched_switch"));
  EXPECT_THAT(options.config.syscalls, ElementsAre("openat", "close"));
  EXPECT_THAT(options.config.context_fields_ust, ElementsAre("vpid"));
  EXPECT_THAT(options.config.context_fields_kernel, ElementsAre("vpid"));
  EXPECT_TRUE(options.list_names && options.config.append_trace && options.config.snapshot_mode);
  EXPECT_EQ(options.config.ust.subbuffer_size, 65536u);
  EXPECT_EQ(options.config.subbuffer_size_kernel, 262144u);
}

TEST(TraceOptions, OptionWithoutNamesDisables) {
  const TraceOptions options = options_of({"-u", "-c", "-s", "run", "--syscall", "openat"});
  EXPECT_THAT(options.config.events_ust, IsEmpty());
  EXPECT_THAT(options.config.context_fields_ust, IsEmpty());
  EXPECT_THAT(options.config.context_fields_kernel, IsEmpty());
  EXPECT_THAT(options.config.syscalls, ElementsAre("openat"));
}

TEST(TraceOptions, StartTakesThemToo) {
  const TraceOptions options = options_of({"start", "run", "-u", "ros2:*", "-p", "/traces", "-l"});
  EXPECT_EQ(options.verb, TraceVerb::kStart);
  EXPECT_EQ(options.config.session_name, "run");
  EXPECT_THAT(options.config.events_ust, ElementsAre("ros2:*"));
  EXPECT_EQ(options.config.base_path, "/traces");
  EXPECT_TRUE(options.list_names);
}

TEST(TraceOptions, OtherVerbsTakeTheNameAlone) {
  EXPECT_EQ(options_of({"pause", "run"}).verb, TraceVerb::kPause);
  EXPECT_EQ(options_of({"resume", "run"}).verb, TraceVerb::kResume);
  EXPECT_EQ(options_of({"stop", "run"}).verb, TraceVerb::kStop);
  EXPECT_EQ(options_of({"record_snapshot", "run"}).verb, TraceVerb::kRecordSnapshot);
  EXPECT_EQ(options_of({"stop", "run"}).config.lttng_session_name(), "run");
}

TEST(TraceOptions, CalibrateTakesTheContextFieldsAlone) {
  EXPECT_EQ(options_of({"calibrate"}).verb, TraceVerb::kCalibrate);
  EXPECT_EQ(options_of({"calibrate"}).config.context_fields_ust, tracing::default_context_fields());
  EXPECT_EQ(options_of({"calibrate", "-c", "vpid"}).config.context_fields_ust, std::vector<std::string>{"vpid"});
  EXPECT_TRUE(options_of({"calibrate", "-c"}).config.context_fields_ust.empty());
  EXPECT_EQ(message_of({"calibrate", "run"}).exit_code, 2);
}

TEST(TraceOptions, StopIsToldWhereTheProcessesOfAKilledLauncherCounted) {
  EXPECT_EQ(options_of({"stop", "run", "--event-counters", "/dev/shm/launch-event-counters-1"}).config.event_counters,
            "/dev/shm/launch-event-counters-1");
}

TEST(TraceOptions, DualSessionActsOnTheRuntimeHalfOrTheSnapshotHalf) {
  for (const char* verb : {"start", "pause", "resume", "stop"}) {
    EXPECT_EQ(options_of({verb, "run", "-d"}).config.lttng_session_name(), "run-runtime") << verb;
  }
  EXPECT_EQ(options_of({"-s", "run", "-d"}).config.lttng_session_name(), "run-runtime");
  EXPECT_EQ(options_of({"record_snapshot", "run", "--dual-session"}).config.lttng_session_name(), "run-snapshot");
}

TEST(TraceOptions, WrongUsageIsExitCodeTwo) {
  EXPECT_EQ(message_of({"start"}).exit_code, 2);
  EXPECT_EQ(message_of({"--session-name", ""}).exit_code, 2);
  EXPECT_THAT(message_of({"start", ""}).text, testing::HasSubstr("the name of a session is not empty"));
  EXPECT_EQ(message_of({"start"}).text,
            "launch trace start: error: session_name is required\n"
            "      = help: see 'launch trace start --help'\n");
  EXPECT_EQ(message_of({"strat", "run"}).text,
            "launch trace: error: unknown command 'strat'\n      = help: did you mean 'start'?\n"
            "      = help: see 'launch trace --help'\n");
  EXPECT_EQ(message_of({"start", "run", "--snapshot-moed"}).text,
            "launch trace start: error: unknown option '--snapshot-moed'\n"
            "      = help: did you mean '--snapshot-mode'?\n"
            "      = help: see 'launch trace start --help'\n");
  EXPECT_EQ(message_of({"--no-such-option"}).exit_code, 2);
  EXPECT_EQ(message_of({"stop", "run", "-u"}).exit_code, 2);
  EXPECT_EQ(message_of({"--subbuffer-size-ust", "many"}).exit_code, 2);
  EXPECT_EQ(message_of({"--subbuffer-size-ust", "-5"}).exit_code, 2);
  EXPECT_EQ(message_of({"--read-timer-ust", "-1"}).exit_code, 2);
}

TEST(TraceOptions, HelpIsExitCodeZero) {
  EXPECT_EQ(message_of({"--help"}).exit_code, 0);
  EXPECT_THAT(message_of({"--help"}).text,
              testing::AllOf(testing::HasSubstr("launch trace"), testing::HasSubstr("--ust"),
                             testing::HasSubstr("record_snapshot")));
  EXPECT_THAT(message_of({"pause", "--help"}).text, testing::HasSubstr("stop recording, keep the session"));
}

}  // namespace
