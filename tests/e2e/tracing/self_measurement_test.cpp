// SPDX-License-Identifier: Apache-2.0
// What a report says of nodes, beside what the nodes have measured themselves.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

using namespace test_support;

// What the tracepoints and the reading of a clock take, at the median, on a machine that is busy with something else.
constexpr std::int64_t kTolerance = 1'000'000;

std::map<std::string, std::int64_t> read_measurement(const std::filesystem::path& path) {
  std::map<std::string, std::int64_t> values;
  std::ifstream file(path);
  std::string name;
  for (std::int64_t value = 0; file >> name >> value;) {
    values[name] = value;
  }
  return values;
}

const nlohmann::json& entry(const nlohmann::json& list, const std::map<std::string, std::string>& members) {
  for (const nlohmann::json& candidate : list) {
    bool fits = true;
    for (const auto& [key, value] : members) {
      fits = fits && candidate.value(key, "") == value;
    }
    if (fits) {
      return candidate;
    }
  }
  static const nlohmann::json none;
  ADD_FAILURE() << "no entry in " << list;
  return none;
}

using Table = std::vector<std::map<std::string, std::string>>;  // rows, by the names of their columns

// A table of `launch report --csv` whose texts have no commas.
Table read_table(const std::filesystem::path& path) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      c == ',' ? cells.emplace_back() : cells.back() += c;
    }
    return cells;
  };
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells_of(line);
  Table table;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cells_of(line);
    for (std::size_t i = 0; i < names.size(); ++i) {
      (i == 0 ? table.emplace_back() : table.back())[names[i]] = cells[i];
    }
  }
  return table;
}

struct Span {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

std::vector<Span> read_spans(const std::filesystem::path& path, const std::string& of) {
  std::vector<Span> spans;
  std::ifstream file(path.string() + ".spans");
  std::string name;
  for (Span span; file >> name >> span.begin_ns >> span.end_ns;) {
    if (name == of) {
      spans.push_back(span);
    }
  }
  return spans;
}

// How far the clock of the trace may be ahead of the nodes' clock, when each of the outer spans holds its inner one.
struct Distance {
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  std::int64_t most = std::numeric_limits<std::int64_t>::max();

  void nodes_measure_within(const Span& traced, const Span& own) {
    least = std::max(least, traced.begin_ns - own.begin_ns);
    most = std::min(most, traced.end_ns - own.end_ns);
  }
  void nodes_measure_around(const Span& traced, const Span& own) {
    least = std::max(least, traced.end_ns - own.end_ns);
    most = std::min(most, traced.begin_ns - own.begin_ns);
  }
};

struct SelfMeasurement : testing::Test {
  std::filesystem::path written(const std::string& node) const { return sandbox.directory() / (node + ".txt"); }
  std::map<std::string, std::int64_t> measured(const std::string& node) const {
    return read_measurement(written(node));
  }

  // Traces the nodes, each one a way of the worker, and returns the report.
  nlohmann::json report_of(const std::vector<std::string>& nodes) {
    const auto file = sandbox.directory() / "measured.launch.xml";
    std::ofstream launch_file(file);
    launch_file << R"(<launch>
  <trace session-name="measured" context-fields="procname vpid vtid" subbuffer-size-ust="1048576">
    <chain name="way" nodes="/talker /listener" budget="1"/>
  </trace>
)";
    for (const std::string& node : nodes) {
      launch_file << "  <executable cmd=\"" WORKER " " << node << " " << written(node).string() << "\"/>\n";
    }
    launch_file << "</launch>\n" << std::flush;
    const CommandResult run = run_command({LAUNCH_PROGRAM, file.string()});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    const CommandResult read = run_command({LAUNCH_PROGRAM, "report", "--json", trace()});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    const CommandResult exported = run_command({LAUNCH_PROGRAM, "report", "--csv", tables().string(), trace()});
    EXPECT_EQ(exported.exit_code, 0) << exported.err;
    nlohmann::json report = nlohmann::json::parse(read.out, nullptr, false);
    EXPECT_TRUE(report["losses"].empty()) << report["losses"];
    return report;
  }
  std::string trace() const { return sandbox.trace_directory() / "measured"; }
  std::filesystem::path tables() const { return sandbox.directory() / "tables"; }

  Sandbox sandbox;
};

TEST_F(SelfMeasurement, EqualsTheReport) {
  const nlohmann::json report = report_of({"listen", "talk"});
  std::map<std::string, std::int64_t> talker = measured("talk");
  std::map<std::string, std::int64_t> listener = measured("listen");
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

  // A tick that takes 35 ms of the 10 ms between two ticks.
  EXPECT_EQ(timer["missed"], talker["missed"]);
  EXPECT_GE(talker["missed"], 2);
  EXPECT_EQ(timer["overruns"], talker["overruns"]);

  const nlohmann::json& callback = entry(report["callbacks"], {{"node", "/listener"}, {"topic", "/topic"}});
  EXPECT_EQ(callback["duration"]["count"], listener["duration_count"] + 1);  // the last one takes no time
  // The report has one message more, so its median may be the next value.
  EXPECT_GE(callback["duration"]["p50_ns"].get<std::int64_t>() + kTolerance, listener["duration_below_median"]);
  EXPECT_LE(callback["duration"]["p50_ns"], listener["duration_above_median"] + kTolerance);

  // The node's latency is around that of the report: from before the call of publish into the callback.
  const nlohmann::json& way = entry(report["subscriptions"], {{"node", "/listener"}, {"topic", "/topic"}});
  EXPECT_EQ(way["delivered"], listener["latency_count"] + 1);
  EXPECT_LE(way["latency"]["p50_ns"], listener["latency_above_median"] + kTolerance);
  EXPECT_GE(way["latency"]["p50_ns"].get<std::int64_t>() + kTolerance, listener["latency_below_median"]);
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

// Nodes read the clock of the trace, and a trace counts from the epoch. So there must be one distance of the two with
// which every callback and every publication lies where the nodes have seen it: within the events of a callback, around
// the events of a publication. Its bounds are as near as the nearest event and reading of the clock.
TEST_F(SelfMeasurement, EachSpanIsWhereTheTraceHasIt) {
  report_of({"listen", "talk"});
  std::map<std::string, std::string> nodes;
  for (auto& row : read_table(tables() / "nodes.csv")) {
    nodes[row["id"]] = row["name"];
  }
  std::map<std::string, std::string> topics;
  for (auto& row : read_table(tables() / "topics.csv")) {
    topics[row["id"]] = row["name"];
  }
  std::map<std::string, std::string> callbacks;
  for (auto& row : read_table(tables() / "callbacks.csv")) {
    callbacks[row["id"]] = nodes[row["node"]] + " " + row["kind"] + topics[row["topic"]];
  }
  std::map<std::string, std::vector<Span>> traced;
  for (auto& row : read_table(tables() / "callback_instances.csv")) {
    const std::int64_t start = std::stoll(row["start_ns"]);
    traced[callbacks[row["callback"]]].push_back({start, start + std::stoll(row["duration_ns"])});
  }
  for (auto& row : read_table(tables() / "messages.csv")) {
    if (row["repeated"] == "1") {
      continue;
    }
    traced["publications of " + topics[row["topic"]]].push_back(
        {std::stoll(row["called_ns"]), std::stoll(row["published_ns"])});
  }

  Distance distance;
  const std::vector<Span> timers = read_spans(written("talk"), "timer");
  const std::vector<Span> publications = read_spans(written("talk"), "publication");
  const std::vector<Span> subscriptions = read_spans(written("listen"), "subscription");
  ASSERT_EQ(traced["/talker timer"].size(), timers.size());
  ASSERT_EQ(traced["publications of /topic"].size(), publications.size());
  ASSERT_EQ(traced["/listener subscription/topic"].size(), subscriptions.size() + 1) << "and the message of the end";
  for (std::size_t i = 0; i < timers.size(); ++i) {
    distance.nodes_measure_within(traced["/talker timer"][i], timers[i]);
    distance.nodes_measure_around(traced["publications of /topic"][i], publications[i]);
  }
  for (std::size_t i = 0; i < subscriptions.size(); ++i) {
    distance.nodes_measure_within(traced["/listener subscription/topic"][i], subscriptions[i]);
  }
  EXPECT_LE(distance.least, distance.most);
  EXPECT_LT(distance.most - distance.least, kTolerance) << "the nearest of 300 events and readings";
  RecordProperty("distance_ns", std::to_string(distance.most - distance.least));
}

TEST_F(SelfMeasurement, EqualsTheCallsInTheReport) {
  const nlohmann::json report = report_of({"call"});
  std::map<std::string, std::int64_t> own = measured("call");
  ASSERT_EQ(own["round_trip_count"], 30);
  const nlohmann::json& call = entry(report["calls"], {{"service", "/question"}, {"client", "/asker"}});
  EXPECT_EQ(call["server"], "/server");
  EXPECT_EQ(call["requests"], own["round_trip_count"]);
  EXPECT_EQ(call["responses"], own["round_trip_count"]);
  // The client's own time begins before the event and ends after it; the service's own time lies within.
  EXPECT_LE(call["round_trip"]["max_ns"], own["round_trip_sum"]);
  EXPECT_LE(call["round_trip"]["p50_ns"], own["round_trip_median"]);
  EXPECT_GE(call["round_trip"]["p50_ns"].get<std::int64_t>() + kTolerance, own["round_trip_median"]);
  EXPECT_GE(call["in_service"]["p50_ns"], own["duration_median"]);
  EXPECT_LE(call["in_service"]["p50_ns"], own["duration_median"] + kTolerance);
  const nlohmann::json& service = entry(report["callbacks"], {{"node", "/server"}, {"service", "/question"}});
  EXPECT_EQ(service["duration"]["count"], own["duration_count"]);
  EXPECT_GE(service["duration"]["p50_ns"], own["duration_median"]);
}

TEST_F(SelfMeasurement, EqualsWhatABufferHasOverwritten) {
  const nlohmann::json report = report_of({"burst_inside"});
  std::map<std::string, std::int64_t> own = measured("burst_inside");
  const nlohmann::json& inner = entry(report["subscriptions"], {{"node", "/inside"}, {"topic", "/inner"}});
  EXPECT_EQ(own["got"], 3) << "as many as there is room for";
  EXPECT_EQ(inner["intra_process"], own["got"]);
  EXPECT_EQ(inner["delivered"], own["got"]);
  EXPECT_EQ(inner["overwritten_in_buffer"], 40 - own["got"]) << inner;
}

TEST_F(SelfMeasurement, EqualsTheMemoryInTheReport) {
  if (test_support::kSanitized) {
    GTEST_SKIP() << test_support::kMallocIsTaken;
  }
  const auto file = sandbox.directory() / "memory.launch.xml";
  std::ofstream(file) << R"(<launch>
  <trace session-name="memory" events-ust="ros2:* lttng_ust_libc:*" subbuffer-size-ust="4194304"/>
  <executable cmd=")" WORKER R"( allocate )"
                      << written("allocate").string() << R"("/>
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
  std::map<std::string, std::int64_t> own = measured("allocate");
  ASSERT_EQ(own["runs"], 50);
  const nlohmann::json& callback = entry(report["callbacks"], {{"node", "/allocator"}, {"owner", "timer"}});
  EXPECT_EQ(callback["duration"]["count"], own["runs"]);
  EXPECT_EQ(callback["allocations"], own["calls"]);
  EXPECT_EQ(callback["allocated_bytes"], own["bytes"]);
}

}  // namespace
