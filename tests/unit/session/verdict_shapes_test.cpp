// SPDX-License-Identifier: Apache-2.0
// The verdict says what babeltrace2 counts, and "complete" only where every event that was fired is in the trace: for
// sessions of many shapes, chosen by seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/unit/session/lttng_tracer_fixture.hpp"
#include "tests/unit/session/trace_reading.hpp"
#include "tracing/record/account/verdict.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/snapshot.hpp"
#include "tracing/record/session/tracer.hpp"

namespace {

using test_support::run_command;
using trace_test::never;
using trace_test::read_trace;
using trace_test::ReadTrace;
using trace_test::TracedApp;
using tracing::TraceConfig;

enum class Shape { kPlain, kRotated, kPaused, kAppended, kTwoChannels, kEarlyEnds, kSnapshot };
constexpr int kShapes = 7;
constexpr const char* kShapeNames[kShapes] = {"plain",        "rotated",    "paused",  "appended",
                                              "two channels", "early ends", "snapshot"};

struct Configuration {
  Shape shape = Shape::kPlain;
  TraceConfig config;
  int processes = 1;
  int bursts = 1;
  int events = 0;  // of a burst
  int bytes = 0;   // of an event's text

  std::string text() const {
    std::string text = kShapeNames[static_cast<int>(shape)];
    text += config.buffers_ust == tracing::BufferOwner::kProcess ? ", pid" : ", uid";
    text += config.overwrite_ust.value_or(false) ? ", overwrite" : ", discard";
    text += ", " + std::to_string(config.ust.subbuffer_count) + " x " + std::to_string(config.ust.subbuffer_size);
    if (config.tracefile_size != 0) {
      text += ", files " + std::to_string(config.tracefile_count) + " x " + std::to_string(config.tracefile_size);
    }
    return text + ", read timer " + std::to_string(config.ust.read_timer) + ", processes " + std::to_string(processes) +
           " x " + std::to_string(bursts) + " x " + std::to_string(events) + " of " + std::to_string(bytes);
  }
};

Configuration configuration_of(unsigned seed, TraceConfig base) {
  std::mt19937 random(seed);
  const auto one_of = [&random](const std::vector<std::uint64_t>& values) { return values[random() % values.size()]; };
  Configuration chosen;
  chosen.shape = static_cast<Shape>(seed % kShapes);
  TraceConfig& config = chosen.config = std::move(base);
  config.buffers_ust = random() % 2 == 0 ? tracing::BufferOwner::kProcess : tracing::BufferOwner::kUser;
  config.overwrite_ust = random() % 2 == 0;
  config.ust.subbuffer_size = one_of({4096, 8192, 16384, 262144});
  config.ust.subbuffer_count = one_of({2, 4});
  config.ust.read_timer = static_cast<std::uint32_t>(one_of({0, 1000, 50'000}));
  if (chosen.shape != Shape::kSnapshot && random() % 2 == 0) {
    config.tracefile_size = config.ust.subbuffer_size * one_of({1, 2, 4});
    config.tracefile_count = one_of({0, 2, 3, 3});
  }
  config.snapshot_mode = chosen.shape == Shape::kSnapshot;
  if (config.snapshot_mode) {
    config.overwrite_ust = true;  // LTTng takes no other
  }
  config.append_trace = chosen.shape == Shape::kAppended;
  if (chosen.shape == Shape::kTwoChannels) {
    config.channels = {{.name = "first_0", .events_ust = {"ros2:rcl_init"}}};
  }
  chosen.processes = static_cast<int>(one_of({1, 2, 3}));
  chosen.bursts = static_cast<int>(one_of({1, 2, 3}));
  chosen.events = static_cast<int>(one_of({20, 400, 4000}));
  chosen.bytes = static_cast<int>(one_of({8, 30, 200}));
  return chosen;
}

struct Counted {
  std::uint64_t discarded = 0;
  std::uint64_t lost_packets = 0;
  bool complete = true;
};

struct VerdictShapes : trace_test::LttngTracer, testing::WithParamInterface<unsigned> {
  void SetUp() override {
    setenv("LTTNG_UST_REGISTER_TIMEOUT", "-1", 1);  // for programs that are no TracedApp
    chosen = configuration_of(GetParam(), config_named("run"));
  }
  void TearDown() override { unsetenv("LTTNG_UST_REGISTER_TIMEOUT"); }

  void fire_in(std::vector<std::unique_ptr<TracedApp>>& apps) {
    for (const auto& app : apps) {
      app->fire_again();
    }
    fired += apps.size() * static_cast<std::uint64_t>(chosen.events);
  }

  std::vector<std::unique_ptr<TracedApp>> start_apps() {
    std::vector<std::unique_ptr<TracedApp>> apps;
    for (int i = 0; i < chosen.processes; ++i) {
      apps.push_back(std::make_unique<TracedApp>(chosen.events, chosen.bytes));
      fired += static_cast<std::uint64_t>(chosen.events) + 1;
    }
    return apps;
  }

  void between_bursts() {
    if (chosen.shape == Shape::kRotated) {
      const auto result = run_command({"lttng", "rotate", "run"});
      EXPECT_EQ(result.exit_code, 0) << result.err;
    } else if (chosen.shape == Shape::kPaused) {
      tracer->pause("run");
      tracer->resume("run");
    } else if (chosen.shape == Shape::kEarlyEnds) {
      const auto result = run_command({TRACED_APP, std::to_string(chosen.events), "10", "abort"});
      EXPECT_EQ(result.signal, SIGABRT);
      fired += static_cast<std::uint64_t>(chosen.events) + 1;
    }
  }

  void run_session() {
    tracer->start(chosen.config);
    auto apps = start_apps();
    for (int burst = 1; burst < chosen.bursts; ++burst) {
      between_bursts();
      fire_in(apps);
      if (burst == 1 && apps.size() > 1) {
        apps.back()->end();
        apps.pop_back();
      }
    }
    between_bursts();
    if (chosen.shape == Shape::kSnapshot) {
      const std::uint64_t asked = tracing::record_snapshot("run");
      const auto snapshots = tracing::snapshots_in(chosen.config.trace_directory());
      ASSERT_FALSE(snapshots.empty());
      recording = snapshots.back();
      tracing::judge_snapshot(recording, "run", {}, {}, {.asked = asked});
    }
    const bool ends_before = GetParam() % 2 == 0;
    if (ends_before) {
      for (const auto& app : apps) {
        app->end();
      }
    }
    tracer->finish(chosen.config, never);
    if (!ends_before) {
      for (const auto& app : apps) {
        app->end();
      }
    }
  }

  void add_verdict(const std::string& directory) {
    const auto verdict = nlohmann::json::parse(test_support::read_file(directory + "/verdict.json"));
    said.discarded += verdict["discarded_events"].get<std::uint64_t>();
    said.lost_packets += verdict["lost_packets"].get<std::uint64_t>();
    said.complete = said.complete && verdict["complete"].get<bool>();
    verdicts += verdict.dump() + "\n";
  }

  Configuration chosen;
  std::uint64_t fired = 0;
  std::string recording;
  Counted said;
  std::string verdicts;
};

TEST_P(VerdictShapes, SaysWhatBabeltraceCounts) {
  recording = chosen.config.trace_directory();
  run_session();
  if (chosen.shape == Shape::kAppended) {
    run_session();
    add_verdict(recording + "/appended-1");
  }
  add_verdict(recording);

  const ReadTrace trace = read_trace(recording);
  std::uint64_t read = 0;
  for (const auto& [name, count] : trace.events) {
    read += static_cast<std::uint64_t>(count);
  }
  std::printf("%2u | %s | fired %ju, read %ju | discarded %ju = %ju | packets %ju = %ju | %s\n", GetParam(),
              chosen.text().c_str(), std::uintmax_t{fired}, std::uintmax_t{read}, std::uintmax_t{trace.discarded},
              std::uintmax_t{said.discarded}, std::uintmax_t{trace.lost_packets}, std::uintmax_t{said.lost_packets},
              said.complete ? "complete" : "incomplete");
  EXPECT_EQ(trace.complaints, "");
  EXPECT_EQ(said.discarded, trace.discarded) << verdicts;
  EXPECT_EQ(said.lost_packets, trace.lost_packets) << verdicts;
  // A snapshot is complete between its first event and its last.
  if (chosen.shape == Shape::kSnapshot) {
    return;
  }
  EXPECT_EQ(said.complete, read == fired) << verdicts;
  if (!*chosen.config.overwrite_ust && chosen.config.tracefile_count == 0) {
    EXPECT_EQ(read + said.discarded, fired) << verdicts;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, VerdictShapes, testing::Range(0U, 40U));

}  // namespace
