// SPDX-License-Identifier: Apache-2.0
// Measures the cost of one tracepoint with two pointers (rcl_publish) for an instrumented line of a program.
//
// Without a session all cases are idle: `LibraryTracepoint` is the way of the stack, `EmptyCall` a function of another
// library that does nothing, `LibraryTracepointWithNumber` has another payload, `InlineTracepoint` is LTTng's bare
// macro without a function around it, `InlineTracepointWithText` the same with 32 characters. To see the cost of
// recording, first start a session with the event ros2:rcl_publish; the label tells whether it was recorded:
//
//   lttng create bench --snapshot && lttng enable-event -u 'ros2:*' && lttng start && bench_tracepoint
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"
#include "tracetools/tracetools.h"

// These are definitions of its own, which the probes of tracetools serve once they are loaded.
#define LTTNG_UST_TRACEPOINT_DEFINE
#define LTTNG_UST_TRACEPOINT_PROBE_DYNAMIC_LINKAGE
#include "provider/provider.h"

extern "C" void empty_call(const void*, const void*);

namespace {

const void* const kHandle = &kHandle;

double floor_ns = 0;  // of EmptyCall, which runs first

double thread_cpu_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

// Runs `step` and reports its time as a multiple of the floor.
template <typename Step>
void measure(benchmark::State& state, Step step) {
  const double begin = thread_cpu_ns();
  for (auto _ : state) {
    step();
  }
  const double per_step = (thread_cpu_ns() - begin) / static_cast<double>(state.iterations());
  if (floor_ns == 0) {
    floor_ns = per_step;
  }
  state.counters["of_floor"] = per_step / floor_ns;
  state.counters["step_ns"] = per_step;
  state.SetLabel(TRACETOOLS_TRACEPOINT_ENABLED(rcl_publish) ? "recorded" : "idle");
}

void EmptyCall(benchmark::State& state) {
  floor_ns = 0;
  measure(state, [&] { empty_call(kHandle, &state); });
}
BENCHMARK(EmptyCall);

void LibraryTracepoint(benchmark::State& state) {
  measure(state, [&] { TRACETOOLS_TRACEPOINT(rcl_publish, kHandle, &state); });
}
BENCHMARK(LibraryTracepoint);

void LibraryTracepointWithNumber(benchmark::State& state) {
  measure(state, [&] { TRACETOOLS_TRACEPOINT(rmw_publish, kHandle, &state, std::int64_t{1}); });
}
BENCHMARK(LibraryTracepointWithNumber);

void EnabledCheck(benchmark::State& state) {
  measure(state, [] { benchmark::DoNotOptimize(TRACETOOLS_TRACEPOINT_ENABLED(rcl_publish)); });
}
BENCHMARK(EnabledCheck);

void InlineTracepoint(benchmark::State& state) {
  measure(state, [&] { lttng_ust_tracepoint(ros2, rcl_publish, kHandle, &state); });
}
BENCHMARK(InlineTracepoint);

// The library's function of an event with text does more: it remembers the object for sessions that start later.
void InlineTracepointWithText(benchmark::State& state) {
  measure(state, [&] {
    lttng_ust_tracepoint(ros2, rcl_lifecycle_transition, kHandle, "sixteen letters.", "sixteen letters.");
  });
}
BENCHMARK(InlineTracepointWithText);

// Prints the runs as usual, and keeps the time of a step in each.
class SampleReporter : public benchmark::ConsoleReporter {
 public:
  SampleReporter() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_Color : OO_None) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration) {
        const std::string& name = run.run_name.function_name;
        std::vector<double>& times = name == "EmptyCall" ? floor_ : cases_[name + ", " + run.report_label];
        times.push_back(run.counters.at("step_ns"));
      }
    }
  }

  void report_samples() const {
    for (const auto& [name, times] : cases_) {
      benchmarks::report({name, "ns", times, "a call of an empty function", floor_});
    }
  }

 private:
  std::vector<double> floor_;
  std::map<std::string, std::vector<double>> cases_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  std::string repetitions = "--benchmark_repetitions=5";
  if (std::getenv("BENCHMARK_SAMPLES") != nullptr) {
    arguments.insert(arguments.begin() + 1, repetitions.data());
  }
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) {
    return EXIT_FAILURE;
  }
  SampleReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.report_samples();
}
