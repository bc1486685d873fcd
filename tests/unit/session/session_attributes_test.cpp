// SPDX-License-Identifier: Apache-2.0
// Reads each attribute of a trace back from the session daemon, and checks its effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/sandbox.hpp"
#include "tests/unit/session/listed_session.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_store.hpp"
#include "tracing/record/session/tracer.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using trace_test::list_session;
using trace_test::ListedChannel;
using trace_test::ListedSession;
using trace_test::read_trace;
using trace_test::TracedApp;
using tracing::BufferOwner;
using tracing::ChannelConfig;
using tracing::LossAccount;
using tracing::TraceConfig;
using tracing::TraceError;

struct SessionAttributes : testing::Test {
  TraceConfig config() const {
    TraceConfig made;
    made.session_name = "run";
    made.base_path = sandbox.trace_directory();
    return made;
  }

  // The daemon's description of the session for `config`.
  ListedSession session_of(const TraceConfig& config) {
    tracer->start(config);
    ListedSession session = list_session(config.lttng_session_name());
    tracer->finish(config, [] { return false; });
    return session;
  }

  std::string start_error(const TraceConfig& config) {
    try {
      tracer->start(config);
    } catch (const TraceError& error) {
      return std::string(error.what()) + "\n" + error.remedy();
    }
    return "no error";
  }

  test_support::Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();
};

TEST_F(SessionAttributes, DefaultsOfTheUserspaceChannel) {
  const ListedSession session = session_of(config());
  EXPECT_TRUE(session.active);
  EXPECT_FALSE(session.snapshot);
  EXPECT_FALSE(session.buffers_per_process);
  EXPECT_EQ(session.path, sandbox.trace_directory().string() + "/run");
  ASSERT_EQ(session.channels.size(), 1u);
  const ListedChannel& channel = session.channel("ros2");
  const TraceConfig defaults;
  EXPECT_FALSE(channel.overwrite);
  EXPECT_EQ(channel.subbuffer_size, defaults.ust.subbuffer_size);
  EXPECT_EQ(channel.subbuffer_count, defaults.ust.subbuffer_count);
  EXPECT_EQ(channel.read_timer, defaults.ust.read_timer);
  EXPECT_EQ(channel.switch_timer, 5'000'000u);
  EXPECT_EQ(channel.blocking_timeout, 0);
  EXPECT_EQ(channel.tracefile_size, 0u);
  EXPECT_EQ(channel.tracefile_count, 0u);
  EXPECT_TRUE(channel.mmap);
  EXPECT_EQ(channel.events.size(), 42u);
}

TEST_F(SessionAttributes, BufferAttributesOfTheUserspaceChannel) {
  TraceConfig asked = config();
  asked.ust.subbuffer_size = 65536;
  asked.ust.subbuffer_count = 8;
  asked.ust.read_timer = 12345;
  asked.switch_timer_ust = 500'000;
  asked.overwrite_ust = true;
  asked.tracefile_size = 1 << 20;
  asked.tracefile_count = 3;
  asked.buffers_ust = BufferOwner::kProcess;
  const ListedSession session = session_of(asked);
  EXPECT_TRUE(session.buffers_per_process);
  const ListedChannel& channel = session.channel("ros2");
  EXPECT_EQ(channel.subbuffer_size, 65536u);
  EXPECT_EQ(channel.subbuffer_count, 8u);
  EXPECT_EQ(channel.read_timer, 12345u);
  EXPECT_EQ(channel.switch_timer, 500'000u);
  EXPECT_TRUE(channel.overwrite);
  EXPECT_EQ(channel.tracefile_size, std::uint64_t{1} << 20);
  EXPECT_EQ(channel.tracefile_count, 3u);
}

TEST_F(SessionAttributes, BlockingTimeouts) {
  TraceConfig asked = config();
  asked.ust.blocking_timeout = 1500;
  EXPECT_EQ(session_of(asked).channel("ros2").blocking_timeout, 1500);
  asked.session_name = "forever";
  asked.ust.blocking_timeout = -1;
  EXPECT_EQ(session_of(asked).channel("ros2").blocking_timeout, -1);
}

TEST_F(SessionAttributes, SnapshotSessionsOverwrite) {
  TraceConfig asked = config();
  asked.snapshot_mode = true;
  const ListedSession session = session_of(asked);
  EXPECT_TRUE(session.snapshot);
  EXPECT_TRUE(session.channel("ros2").overwrite);
  EXPECT_EQ(session.channel("ros2").switch_timer, 0u) << "a part-full sub-buffer would be room that is wasted";
  EXPECT_EQ(session.channel("ros2").subbuffer_count, asked.ust.subbuffer_count);
}

TEST_F(SessionAttributes, EventRulesWithFilterExclusionsAndLevels) {
  TraceConfig asked = config();
  asked.events_ust = {"ros2:rmw_take if taken == 1 && message != 0", "ros2:rcl_* except ros2:rcl_init,ros2:rcl_take",
                      "my:* level WARNING", "other:* level =DEBUG_LINE"};
  const ListedChannel channel = session_of(asked).channel("ros2");
  const std::vector<std::string> names = channel.event_names();
  ASSERT_EQ(names.size(), 3u + 9u) << "there are eleven of rcl";
  EXPECT_THAT(names, testing::AllOf(Contains("ros2:rcl_publish"), Not(Contains("ros2:rcl_init"))));
  EXPECT_EQ(channel.events[0].level, ">= 4");
  EXPECT_EQ(channel.events[1].level, "== 13");
  EXPECT_EQ(channel.events[2].level, "");
  EXPECT_EQ(channel.events.back().name, "ros2:rmw_take");
  EXPECT_EQ(channel.events.back().filter, "taken == 1 && message != 0");
}

TEST_F(SessionAttributes, FiltersAndExclusionsHold) {
  TraceConfig asked = config();
  asked.events_ust = {"ros2:rclcpp_callback_register if callback <= 7", "ros2:rcl_* except ros2:rcl_init"};
  tracer->start(asked);
  TracedApp(20, 10).end();
  tracer->finish(asked, [] { return false; });
  EXPECT_EQ(read_trace(asked.trace_directory()).events,
            (std::map<std::string, int>{{"ros2:rclcpp_callback_register", 7}}));
}

TEST_F(SessionAttributes, FurtherChannelsHaveTheirOwnEventsAndBuffers) {
  TraceConfig asked = config();
  asked.launch_events = true;
  ChannelConfig callbacks{.name = "callbacks", .events_ust = {"ros2:callback_*", "ros2:rclcpp_callback_register"}};
  callbacks.subbuffer_size = 8192;
  callbacks.subbuffer_count = 16;
  callbacks.read_timer = 777;
  callbacks.switch_timer = 888'000;
  callbacks.overwrite = true;
  callbacks.context_fields = {"vtid"};
  asked.channels = {callbacks, {.name = "mine", .events_ust = {"my:*"}, .blocking_timeout = 10}};
  tracer->start(asked);
  const ListedSession session = list_session("run");
  TracedApp(3, 10).end();
  tracer->finish(asked, [] { return false; });

  ASSERT_EQ(session.channels.size(), 3u);
  const ListedChannel& first = session.channel("callbacks");
  EXPECT_THAT(first.event_names(), ElementsAre("ros2:callback_*", "ros2:rclcpp_callback_register"));
  EXPECT_EQ(first.subbuffer_size, 8192u);
  EXPECT_EQ(first.subbuffer_count, 16u);
  EXPECT_EQ(first.read_timer, 777u);
  EXPECT_EQ(first.switch_timer, 888'000u);
  EXPECT_TRUE(first.overwrite);
  const ListedChannel& second = session.channel("mine");
  EXPECT_EQ(second.subbuffer_size, asked.ust.subbuffer_size) << "as the main channel";
  EXPECT_EQ(second.blocking_timeout, 10);
  const std::vector<std::string> rest = session.channel("ros2").event_names();
  EXPECT_EQ(rest.size(), 42u - 3u + 1u) << "default events are taken once; and those of the launcher";
  EXPECT_THAT(rest, Not(Contains("ros2:callback_start")));
  EXPECT_THAT(rest, Contains("launch:*"));

  const auto trace = read_trace(asked.trace_directory());
  EXPECT_EQ(trace.events.at("ros2:rclcpp_callback_register"), 3);
  for (const std::string& line : trace.lines) {
    const bool in_first = line.find("rclcpp_callback_register") != std::string::npos;
    EXPECT_EQ(line.find("procname") == std::string::npos, in_first) << line;
  }
}

TEST_F(SessionAttributes, BlockingChannelsLoseNothing) {
  TraceConfig asked = config();
  asked.ust.subbuffer_size = 4096;
  asked.ust.subbuffer_count = 2;
  asked.ust.blocking_timeout = -1;
  setenv("LTTNG_UST_ALLOW_BLOCKING", "1", 1);
  tracer->start(asked);
  constexpr int kEvents = 400;  // ten times what the buffers hold; a waiting thread looks again after 100 ms
  TracedApp(kEvents, 200).end();
  const LossAccount losses = tracer->finish(asked, [] { return false; });
  unsetenv("LTTNG_UST_ALLOW_BLOCKING");
  EXPECT_EQ(losses.discarded_events(), 0u);
  EXPECT_EQ(read_trace(asked.trace_directory()).events.at("ros2:rclcpp_callback_register"), kEvents);
}

TEST_F(SessionAttributes, NoMoreTraceFilesAreKeptThanAskedFor) {
  TraceConfig asked = config();
  asked.ust.subbuffer_size = 4096;
  asked.tracefile_size = 16384;
  asked.tracefile_count = 2;
  tracer->start(asked);
  TracedApp app(100, 1000);
  for (int i = 0; i < 10; ++i) {
    app.fire_again();
  }
  app.end();
  tracer->finish(asked, [] { return false; });
  std::map<std::string, int> files;  // of each processor's stream
  for (const auto& entry : std::filesystem::recursive_directory_iterator(asked.trace_directory())) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("ros2_") || entry.path().extension() == ".idx") {
      continue;
    }
    EXPECT_LE(entry.file_size(), 16384u) << name;
    ++files[name.substr(0, name.rfind('_'))];
  }
  ASSERT_FALSE(files.empty());
  for (const auto& [stream, count] : files) {
    EXPECT_LE(count, 2) << stream;
  }
}

TEST_F(SessionAttributes, BuffersPerProcessAreRecordedPerProcess) {
  TraceConfig asked = config();
  asked.buffers_ust = BufferOwner::kProcess;
  tracer->start(asked);
  TracedApp(5, 10).end();
  tracer->finish(asked, [] { return false; });
  EXPECT_TRUE(std::filesystem::exists(asked.trace_directory() + "/ust/pid"));
  EXPECT_EQ(read_trace(asked.trace_directory()).events.at("ros2:rclcpp_callback_register"), 5);
}

TEST_F(SessionAttributes, WhatExcludesEachOtherIsAnErrorAndLeavesNoSession) {
  const auto error_with = [&](auto change) {
    TraceConfig asked = config();
    change(asked);
    return start_error(asked);
  };
  EXPECT_EQ(error_with([](TraceConfig& c) { c.overwrite_ust = true, c.ust.blocking_timeout = 5; }),
            "channel 'ros2' both overwrites and blocks\n"
            "a channel that overwrites always has room: leave one of them out");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.snapshot_mode = true, c.overwrite_ust = false; }),
            "channel 'ros2' of a snapshot session must overwrite\n"
            "leave the overwrite attribute out: a snapshot is of the newest events");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.ust.blocking_timeout = -2; }),
            "blocking timeout of -2 microseconds for channel 'ros2'\n-1 waits for ever, 0 never");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.tracefile_count = 2; }),
            "a number of trace files is given without their size\nadd tracefile-size");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.channels = {{.name = "empty"}}; }),
            "channel 'empty' has no events\nname some in events-ust, events-kernel or syscalls");
  EXPECT_EQ(error_with([](TraceConfig& c) {
              c.channels = {{.name = "both", .events_ust = {"a:b"}, .events_kernel = {"sched_switch"}}};
            }),
            "channel 'both' has userspace and kernel events\nmake it two channels: each belongs to one domain");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.channels = {{.name = "ros2", .events_ust = {"a:b"}}}; }),
            "there are two channels 'ros2'\ngive one another name");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.channels = {{.name = "a/b", .events_ust = {"a:b"}}}; }),
            "'a/b' is no name for a channel\na name has 1 to 255 characters, none of them '/', and begins with no '.'");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.events_kernel = {"sched_switch level INFO"}; }),
            "kernel event 'sched_switch' has a log level\nonly userspace events can have one");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.events_ust = {"my:* except my:own"}; }),
            "nothing can be taken out of 'my:*': only of events of provider ros2\n"
            "name the events one by one, or use a filter");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.url = "/a/directory"; }),
            "'/a/directory' is no address of a relay daemon\n"
            "write net://HOST[:CONTROL[:DATA]]; a directory is given by base-path (launch trace: --path)");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.live_timer = 1000, c.snapshot_mode = true; }),
            "trace session 'run' is both live and a snapshot session\nleave live-timer or snapshot-mode out");
  EXPECT_EQ(error_with([](TraceConfig& c) { c.events_ust = {"ros2:* if ((("}; }),
            "LTTng does not understand the filter of event 'ros2:*': (((\n"
            "lttng-enable-event(1) describes filter expressions");
  EXPECT_EQ(trace_test::listed_sessions(), "");
}

TEST_F(SessionAttributes, TraceFilesSmallerThanASubbufferAreRoundedUpWithAWarning) {
  TraceConfig asked = config();
  asked.ust.subbuffer_size = 65536;
  asked.tracefile_size = 4096;
  EXPECT_THAT(tracer->start(asked).warnings,
              ElementsAre("trace files of 4096 bytes are rounded up to 65536, a sub-buffer of channel 'ros2'"));
  EXPECT_EQ(list_session("run").channel("ros2").tracefile_size, 65536u);
  tracer->finish(asked, [] { return false; });
}

TEST_F(SessionAttributes, ASavedSessionIsLoadedAsItWas) {
  TraceConfig asked = config();
  asked.ust.subbuffer_size = 65536;
  asked.events_ust = {"ros2:rclcpp_callback_register if callback <= 7"};
  tracer->start(asked);
  const std::string directory = sandbox.directory() / "saved";
  tracer->save("run", directory);
  EXPECT_TRUE(std::filesystem::exists(directory + "/run.lttng"));
  tracer->finish(asked, [] { return false; });
  ASSERT_FALSE(list_session("run").exists);

  tracer->load("run", directory);
  const ListedSession session = list_session("run");
  EXPECT_TRUE(session.active) << "it was, when it was saved";
  EXPECT_EQ(session.channel("ros2").subbuffer_size, 65536u);
  ASSERT_THAT(session.channel("ros2").event_names(), ElementsAre("ros2:rclcpp_callback_register"));
  EXPECT_EQ(session.channel("ros2").events[0].filter, "callback <= 7");
  tracer->finish(asked, [] { return false; });
}

TEST_F(SessionAttributes, LoadingWhatWasNotSavedIsAnError) {
  tracing::ensure_session_daemon();
  std::filesystem::create_directories(sandbox.directory() / "saved");
  for (const std::string& directory : {(sandbox.directory() / "saved").string(), std::string()}) {
    try {
      tracer->load("run", directory);
      FAIL() << "no error";
    } catch (const TraceError& error) {
      EXPECT_EQ(error.what(), "there is no saved session 'run': " + tracing::file_of_saved_session("run", directory) +
                                  " does not exist");
      EXPECT_EQ(error.remedy(), "`launch trace save` writes one");
    }
  }
}

}  // namespace
