// SPDX-License-Identifier: Apache-2.0
// What is kept of the example system of tests/support/trace_writer/example_system.hpp.
#include "tracing/model/compare/run_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"

namespace tracing::compare {
namespace {

using ::testing::ElementsAre;

RunSummary recorded(std::uint64_t cycles) {
  const tracing::testing::TemporaryDirectory directory;
  tracing::testing::write_example_system(directory.path() / "trace", cycles);
  RunRecorder recorder;
  TraceAnalysis analysis(&recorder);
  recorder.use(analysis.objects());
  TraceReader(directory.path() / "trace").read(analysis);
  const TraceResults results = analysis.finish();
  return recorder.finish(analysis, results);
}

const Measurement& find(const RunSummary& run, std::string_view subject, std::string_view quantity) {
  const auto found = std::find_if(run.measurements.begin(), run.measurements.end(), [&](const Measurement& one) {
    return one.subject == subject && one.quantity == quantity;
  });
  if (found == run.measurements.end()) {
    throw std::runtime_error("no " + std::string(quantity) + " of " + std::string(subject));
  }
  return *found;
}

TEST(RunRecorder, NamesEverythingWithoutNumbersOfProcesses) {
  std::vector<std::string> names;
  for (const Measurement& one : recorded(3).measurements) {
    names.push_back(std::string(kind_name(one.kind)) + ": " + one.subject + ": " + one.quantity);
  }
  EXPECT_THAT(names, ElementsAre("callback: /display, subscription /points: duration",
                                 "callback: /display, subscription /points: interval",
                                 "callback: /filter, subscription /scan: duration",
                                 "callback: /filter, subscription /scan: interval",
                                 "callback: /sensor, timer 10 ms: duration", "callback: /sensor, timer 10 ms: interval",
                                 "hop: /points to /display: latency", "hop: /points to /display: on the way",
                                 "hop: /points to /display: waiting for the executor", "hop: /scan to /filter: latency",
                                 "hop: /scan to /filter: on the way", "hop: /scan to /filter: waiting for the executor",
                                 "chain: /sensor (timer 10 ms) -> /filter (/scan) -> /display (/points): response"));
}

TEST(RunRecorder, KeepsTheSamplesInTheOrderOfTime) {
  const RunSummary run = recorded(60);
  const Measurement& filter = find(run, "/filter, subscription /scan", "duration");
  EXPECT_EQ(filter.count, 60u);
  ASSERT_EQ(filter.samples.size(), 60u);
  EXPECT_EQ(filter.samples[1], 400'000);
  EXPECT_EQ(std::count(filter.samples.begin(), filter.samples.end(), 4'000'000), 3);
  const Measurement& chain = find(run, "/sensor (timer 10 ms) -> /filter (/scan) -> /display (/points)", "response");
  EXPECT_THAT(chain.steps,
              ElementsAre("/sensor, timer 10 ms", "/filter, subscription /scan", "/display, subscription /points"));
  EXPECT_EQ(chain.count, 59u) << "nobody takes one of the messages";
  EXPECT_EQ(filter.sends, true);
  EXPECT_EQ(find(run, "/display, subscription /points", "duration").sends, std::nullopt) << "its process sends nothing";
  EXPECT_FALSE(chain.waits);
  EXPECT_EQ(run.begin_ns, tracing::testing::kExampleBegin);
  EXPECT_GT(run.events, 1000u);
}

}  // namespace
}  // namespace tracing::compare
