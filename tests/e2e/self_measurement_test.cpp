// SPDX-License-Identifier: Apache-2.0
// What a report says of nodes, beside what the nodes have measured themselves.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;

// What the tracepoints and the reading of a clock take, at the median, on a machine that is busy with something else.
constexpr std::int64_t kTolerance = 300'000;

std::map<std::string, std::int64_t> read_measurement(const std::filesystem::path& path) {
  std::map<std::string, std::int64_t> values;
  std::ifstream file(path);
  std::string name;
  for (std::int64_t value = 0; file >> name >> value;) values[name] = value;
  return values;
}

const nlohmann::json& entry(const nlohmann::json& list, const std::map<std::string, std::string>& members) {
  for (const nlohmann::json& candidate : list) {
    bool fits = true;
    for (const auto& [key, value] : members) fits = fits && candidate.value(key, "") == value;
    if (fits) return candidate;
  }
  static const nlohmann::json none;
  ADD_FAILURE() << "no entry in " << list;
  return none;
}

TEST(SelfMeasurement, EqualsTheReport) {
  Sandbox sandbox;
  const auto file = sandbox.directory() / "measured.launch.xml";
  const auto of_talker = sandbox.directory() / "talker.txt";
  const auto of_listener = sandbox.directory() / "listener.txt";
  std::ofstream(file) << R"(<launch>
  <trace session-name="measured" context-fields="procname vpid vtid" subbuffer-size-ust="1048576">
    <chain name="way" nodes="/talker /listener" budget="1"/>
  </trace>
  <executable cmd=")" WORKER R"( listen )"
                      << of_listener.string() << R"("/>
  <executable cmd=")" WORKER R"( talk )"
                      << of_talker.string() << R"("/>
</launch>
)";
  const CommandResult run = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const CommandResult read =
      run_command({LAUNCH_PROGRAM, "report", "--json", (sandbox.trace_directory() / "measured").string()});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const nlohmann::json report = nlohmann::json::parse(read.out);
  ASSERT_TRUE(report["losses"].empty()) << report["losses"];
  std::map<std::string, std::int64_t> talker = read_measurement(of_talker);
  std::map<std::string, std::int64_t> listener = read_measurement(of_listener);
  ASSERT_EQ(talker["duration_count"], 100);
  ASSERT_GT(listener["latency_count"], 50);

  // The tracepoints of a callback are around what the node measures.
  const nlohmann::json& timer = entry(report["callbacks"], {{"node", "/talker"}, {"owner", "timer"}});
  EXPECT_EQ(timer["duration"]["count"], talker["duration_count"]);
  EXPECT_GE(timer["duration"]["p50_ns"], talker["duration_median"]);
  EXPECT_LE(timer["duration"]["p50_ns"], talker["duration_median"] + kTolerance);
  EXPECT_EQ(timer["interval"]["count"], talker["interval_count"]);
  EXPECT_NEAR(timer["interval"]["p50_ns"].get<double>(), static_cast<double>(talker["interval_median"]), kTolerance);
  EXPECT_NEAR(timer["interval"]["mean_ns"].get<double>(),
              static_cast<double>(talker["interval_sum"]) / static_cast<double>(talker["interval_count"]), kTolerance);

  const nlohmann::json& callback = entry(report["callbacks"], {{"node", "/listener"}, {"topic", "/topic"}});
  EXPECT_EQ(callback["duration"]["count"], listener["duration_count"] + 1);  // the last one takes no time
  EXPECT_GE(callback["duration"]["p50_ns"].get<std::int64_t>() + kTolerance, listener["duration_median"]);
  EXPECT_LE(callback["duration"]["p50_ns"], listener["duration_median"] + kTolerance);

  // The node's latency is around that of the report: from before the call of publish into the callback.
  const nlohmann::json& way = entry(report["subscriptions"], {{"node", "/listener"}, {"topic", "/topic"}});
  EXPECT_EQ(way["delivered"], listener["latency_count"] + 1);
  EXPECT_LE(way["latency"]["p50_ns"], listener["latency_median"] + kTolerance);
  EXPECT_GE(way["latency"]["p50_ns"].get<std::int64_t>() + kTolerance, listener["latency_median"]);
  const auto mean = [&way](const char* part) { return way[part]["mean_ns"].get<double>(); };
  EXPECT_NEAR(mean("rclcpp") + mean("rcl") + mean("transport") + mean("executor") + mean("take"), mean("latency"), 1);

  // Every message of the burst is accounted for.
  const nlohmann::json& burst = entry(report["subscriptions"], {{"node", "/listener"}, {"topic", "/burst"}});
  EXPECT_EQ(burst["delivered"], listener["burst"]);
  std::int64_t missing = 0;
  for (const char* place : {"overwritten", "lost", "not_executed", "before_first", "after_last"}) {
    missing += burst[place].get<std::int64_t>();
  }
  EXPECT_EQ(missing, 40 - listener["burst"]) << burst;

  // The launch file has named the chain. Its last callback alone takes as long as its budget.
  const nlohmann::json& chain = entry(report["chains"], {{"name", "way"}});
  EXPECT_EQ(chain["steps"][0]["node"], "/talker");
  EXPECT_EQ(chain["steps"][1]["node"], "/listener");
  EXPECT_EQ(chain["budget_ns"], 1'000'000);
  EXPECT_GE(chain["over_budget"].get<std::int64_t>(), listener["duration_count"] - 1) << "but not the end message";
  EXPECT_TRUE(report["unseen_chains"].empty());

  // The critical path has no gaps, and ends when the last process is ready.
  const nlohmann::json& startup = report["startup"];
  std::int64_t end = startup["begin_ns"].get<std::int64_t>();
  for (const nlohmann::json& step : startup["critical_path"]) {
    EXPECT_EQ(step["begin_ns"], end) << startup;
    end = step["end_ns"].get<std::int64_t>();
  }
  EXPECT_EQ(startup["ready_ns"], end) << startup;
  ASSERT_EQ(report["starts"].size(), 2u);
  for (const nlohmann::json& start : report["starts"]) {
    EXPECT_LE(start["spawn_ns"], start["exec_ns"]);
    EXPECT_LE(start["init_after_ns"], start["node_after_ns"]);
    EXPECT_LE(start["node_after_ns"], start["ready_after_ns"]);
    EXPECT_LE(start["ready_after_ns"], start["callback_after_ns"]);
  }
}

TEST(SelfMeasurement, EqualsTheMemoryInTheReport) {
  Sandbox sandbox;
  const auto file = sandbox.directory() / "memory.launch.xml";
  const auto measured = sandbox.directory() / "allocator.txt";
  std::ofstream(file) << R"(<launch>
  <trace session-name="memory" events-ust="ros2:* lttng_ust_libc:*" subbuffer-size-ust="4194304"/>
  <executable cmd=")" WORKER R"( allocate )"
                      << measured.string() << R"("/>
</launch>
)";
  const CommandResult run = run_command({LAUNCH_PROGRAM, file.string()});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  if ((run.out + run.err).find("liblttng-ust-libc-wrapper") != std::string::npos) {
    GTEST_SKIP() << "LTTng's wrapper of the C library is not installed: " << run.err;
  }
  const CommandResult read =
      run_command({LAUNCH_PROGRAM, "report", "--json", (sandbox.trace_directory() / "memory").string()});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const nlohmann::json report = nlohmann::json::parse(read.out);
  ASSERT_TRUE(report["losses"].empty()) << report["losses"];
  std::map<std::string, std::int64_t> own = read_measurement(measured);
  ASSERT_EQ(own["runs"], 50);
  const nlohmann::json& callback = entry(report["callbacks"], {{"node", "/allocator"}, {"owner", "timer"}});
  EXPECT_EQ(callback["duration"]["count"], own["runs"]);
  EXPECT_EQ(callback["allocations"], own["calls"]);
  EXPECT_EQ(callback["allocated_bytes"], own["bytes"]);
}

}  // namespace
