// SPDX-License-Identifier: Apache-2.0
// perf_test and reference_system as a user runs them.
#include <gmock/gmock.h>

#include <latency_statistics.hpp>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using test_support::RunningCommand;
using testing::HasSubstr;

namespace {

constexpr const char* kPerfTest = PREFIX "/lib/performance_test/perf_test";
constexpr const char* kReferenceSystem = PREFIX "/lib/reference_system/reference_system";

Command perf_test(const std::vector<std::string>& parameters) {
  Command command{{kPerfTest, "--ros-args"}};
  for (const std::string& parameter : parameters) {
    command.argv.insert(command.argv.end(), {"-p", parameter});
  }
  return command;
}

// The results of a run of about two seconds.
nlohmann::json measure(const test_support::Sandbox& sandbox, std::vector<std::string> parameters) {
  const std::string logfile = (sandbox.directory() / "result.json").string();
  // The queue is so long that nothing is lost, however long a busy machine keeps a thread waiting.
  parameters.insert(parameters.end(), {"max_runtime:=2", "history_depth:=1000", "logfile:=" + logfile});
  const CommandResult result = run_command(perf_test(parameters));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\ntotal    sent "));
  return nlohmann::json::parse(test_support::read_file(logfile));
}

void expect_plausible(const nlohmann::json& result) {
  const auto& summary = result["summary"];
  EXPECT_GT(summary["received"], 0);
  EXPECT_EQ(summary["lost"], 0);
  EXPECT_GT(summary["latency_min_ms"], 0);
  EXPECT_LE(summary["latency_min_ms"], summary["latency_p50_ms"]);
  EXPECT_LE(summary["latency_p50_ms"], summary["latency_p999_ms"]);
  EXPECT_LE(summary["latency_p999_ms"], summary["latency_max_ms"]);
  EXPECT_GE(result["analysis_results"].size(), 1U);
}

TEST(LatencyStatistics, SumUpOneToAThousand) {
  std::vector<int64_t> latencies(1000);
  std::iota(latencies.rbegin(), latencies.rend(), 1);
  for (int64_t& latency : latencies) {
    latency *= 1000000;
  }
  const performance_test::LatencySummary summary = performance_test::summarize(latencies);
  EXPECT_DOUBLE_EQ(summary.min, 1);
  EXPECT_DOUBLE_EQ(summary.mean, 500.5);
  EXPECT_NEAR(summary.standard_deviation, 288.675, 0.001);
  EXPECT_DOUBLE_EQ(summary.median, 500);
  EXPECT_DOUBLE_EQ(summary.p90, 900);
  EXPECT_DOUBLE_EQ(summary.p99, 990);
  EXPECT_DOUBLE_EQ(summary.p999, 999);
  EXPECT_DOUBLE_EQ(summary.max, 1000);
}

TEST(LatencyStatistics, AreZeroWithoutMessages) {
  EXPECT_EQ(performance_test::summarize({}).max, 0);
}

TEST(PerfTest, MeasuresWithinAProcess) {
  const test_support::Sandbox sandbox;
  const nlohmann::json result = measure(sandbox, {"msg:=Array4k", "rate:=50", "subscribers:=2"});
  expect_plausible(result);
  EXPECT_EQ(result["msg"], "Array4k");
  EXPECT_EQ(result["summary"]["data_received_bytes"].get<double>() / result["summary"]["received"].get<double>(),
            4096 + 24);
}

TEST(PerfTest, MeasuresMessagesByPointerAndOnLoan) {
  const test_support::Sandbox sandbox;
  expect_plausible(measure(sandbox, {"msg:=Array64k", "rate:=50", "intra_process:=true"}));
  expect_plausible(measure(sandbox, {"msg:=Array64k", "rate:=50", "zero_copy:=true"}));
}

TEST(PerfTest, MeasuresBetweenProcessesAndWritesATable) {
  const test_support::Sandbox sandbox;
  const std::string logfile = (sandbox.directory() / "result.csv").string();
  RunningCommand publisher(perf_test({"subscribers:=0", "expected_subscribers:=1", "rate:=50"}));
  const CommandResult subscriber =
      run_command(perf_test({"publishers:=0", "expected_publishers:=1", "max_runtime:=2", "logfile:=" + logfile}));
  EXPECT_EQ(subscriber.exit_code, 0) << subscriber.err;
  publisher.send_signal(SIGINT);
  EXPECT_EQ(publisher.wait().exit_code, 0);

  std::istringstream table(test_support::read_file(logfile));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line,
            "T_experiment,T_interval,sent,received,lost,data_received_bytes,latency_min_ms,latency_mean_ms,"
            "latency_stddev_ms,latency_p50_ms,latency_p90_ms,latency_p99_ms,latency_p999_ms,latency_max_ms");
  int received = 0;
  while (std::getline(table, line)) {
    double values[4];
    char comma = 0;
    std::istringstream row(line);
    row >> values[0] >> comma >> values[1] >> comma >> values[2] >> comma >> values[3];
    EXPECT_EQ(values[2], 0) << line;
    received += static_cast<int>(values[3]);
  }
  EXPECT_GT(received, 0);
}

TEST(PerfTest, SaysWhatIsWrongWithAParameter) {
  const test_support::Sandbox sandbox;
  const auto error_of = [](const std::vector<std::string>& parameters) {
    const CommandResult result = run_command(perf_test(parameters));
    EXPECT_EQ(result.exit_code, 1);
    return result.err;
  };
  EXPECT_EQ(
      error_of({"msg:=Array3k"}),
      "perf_test: parameter 'msg' is 'Array3k': it must be one of Array1k, Array4k, Array16k, Array32k, Array64k, "
      "Array256k, Array1m, Array4m\n");
  EXPECT_EQ(error_of({"reliability:=some"}),
            "perf_test: parameter 'reliability' is 'some': it must be reliable or best_effort\n");
  EXPECT_EQ(error_of({"publishers:=0", "subscribers:=0"}),
            "perf_test: parameters 'publishers' and 'subscribers' are both 0: there is nothing to measure\n");
  EXPECT_EQ(error_of({"logfile:=result.txt"}),
            "perf_test: parameter 'logfile' is 'result.txt': it must be a file name that ends with .csv or .json\n");
  EXPECT_EQ(error_of({"logfile:=/no/such/folder/a.csv"}),
            "perf_test: cannot write '/no/such/folder/a.csv': No such file or directory\n");
}

TEST(ReferenceSystem, MessagesComeThroughTheWholeGraph) {
  const test_support::Sandbox sandbox;
  for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--intra-process"}}) {
    Command command{{kReferenceSystem, "--messages", "2", "--number-crunch-limit", "64"}};
    command.argv.insert(command.argv.end(), options.begin(), options.end());
    const CommandResult result = run_command(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const char* sensor : {"FrontLidarDriver", "RearLidarDriver", "PointCloudMap", "Visualizer", "Lanelet2Map"}) {
      EXPECT_THAT(result.err, HasSubstr("messages from " + std::string(sensor) + ": min "));
    }
  }
}

TEST(ReferenceSystem, ListsItsGraph) {
  const test_support::Sandbox sandbox;
  const CommandResult result = run_command({kReferenceSystem, "--list", "BehaviorPlanner", "FrontLidarDriver"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out,
            "BehaviorPlanner\n  ObjectCollisionEstimator\n  NDTLocalizer\n  Lanelet2GlobalPlanner\n"
            "  Lanelet2MapLoader\n  ParkingPlanner\n  LanePlanner\nFrontLidarDriver\n");
}

TEST(ReferenceSystem, SaysWhatItDoesNotKnow) {
  const test_support::Sandbox sandbox;
  const auto error_of = [](const std::vector<std::string>& arguments) {
    std::vector<std::string> argv = {kReferenceSystem};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    const CommandResult result = run_command(argv);
    EXPECT_EQ(result.exit_code, 1);
    return result.err;
  };
  EXPECT_THAT(error_of({"Lidar"}), testing::StartsWith("reference_system: there is no node 'Lidar' in the reference "
                                                       "system: it has FrontLidarDriver, RearLidarDriver, "));
  EXPECT_EQ(error_of({"--fast"}),
            "reference_system: unknown option '--fast': there are --number-crunch-limit, --intra-process, --messages "
            "and --list\n");
  EXPECT_EQ(error_of({"--messages", "many"}), "reference_system: option --messages: 'many' is no number\n");
  EXPECT_EQ(error_of({"--messages"}), "reference_system: option --messages needs a number\n");
}

}  // namespace
