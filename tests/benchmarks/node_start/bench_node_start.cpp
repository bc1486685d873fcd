// SPDX-License-Identifier: Apache-2.0
// Usage: bench_node_start [RUNS]
//
// What an empty node costs: the time from exec to its main() and to the end of its first spin, the processor time until
// then, its memory, and the time from SIGINT to its end. The floor is a participant of bare Fast DDS with two
// endpoints. First without a session, then with one that records all events of the stack; the node and the
// floor run in turns. Default: 40 runs.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "ready_node.hpp"
#include "tests/benchmarks/latency/latency_run.hpp"
#include "tests/benchmarks/latency/tracing_session.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace {

using node_start::now;
using node_start::Ready;

constexpr int kDefaultRuns = 40;

struct Column {
  const char* name;
  const char* unit;
  std::vector<double> values = {};
};

// One value for each run.
struct Measured {
  Column to_main{"exec to main()", "ms"};
  Column to_ready{"exec to the end of the first spin", "ms"};
  Column processor{"processor time until then", "ms"};
  Column memory{"memory (Pss)", "MiB"};
  Column end{"SIGINT to the end", "ms"};

  std::vector<const Column*> columns() const { return {&to_main, &to_ready, &processor, &memory, &end}; }
};

double milliseconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / 1e6;
}

double mebibytes_of(pid_t pid) {
  std::ifstream maps(fmt::format("/proc/{}/smaps_rollup", pid));
  for (std::string line; std::getline(maps, line);) {
    if (line.starts_with("Pss:")) {
      return static_cast<double>(std::stol(line.substr(4))) / 1024;
    }
  }
  return 0;
}

void measure(Measured& measured, const char* program) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) {
    latency::fail("no pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  char* const argv[] = {const_cast<char*>(program), nullptr};
  const std::int64_t begin = now(CLOCK_MONOTONIC);
  pid_t pid = -1;
  if (posix_spawn(&pid, program, &actions, nullptr, argv, environ) != 0) {
    latency::fail(fmt::format("{} does not start", program));
  }
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  Ready ready{};
  if (read(pipe_ends[0], &ready, sizeof ready) != sizeof ready) {
    latency::fail(fmt::format("{} does not start", program));
  }
  close(pipe_ends[0]);
  measured.to_main.values.push_back(milliseconds(ready.main_begun - begin));
  measured.to_ready.values.push_back(milliseconds(ready.ready - begin));
  measured.processor.values.push_back(milliseconds(ready.processor_time));
  measured.memory.values.push_back(mebibytes_of(pid));
  const std::int64_t end = now(CLOCK_MONOTONIC);
  kill(pid, SIGINT);
  waitpid(pid, nullptr, 0);
  measured.end.values.push_back(milliseconds(now(CLOCK_MONOTONIC) - end));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(const std::string& how, int runs) {
  Measured node;
  Measured bare;
  for (int i = 0; i < runs; ++i) {
    measure(node, STACK_NODE);
    measure(bare, BARE_NODE);
  }
  fmt::print("{}, median of {} runs\n", how, runs);
  const auto floors = bare.columns();
  auto floor = floors.begin();
  for (const Column* const column : node.columns()) {
    const double value = median(column->values);
    const double least = median((*floor)->values);
    fmt::print("  {:34} {:7.2f} {:3}   bare Fast DDS {:7.2f}   ratio {:.2f}\n", column->name, value, column->unit,
               least, value / least);
    benchmarks::report(
        {how + ", " + column->name, column->unit, column->values, "a bare participant", (*floor)->values});
    ++floor;
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  // A shell has its background commands ignore SIGINT, which ends the processes here.
  signal(SIGINT, SIG_DFL);
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : kDefaultRuns;
  setenv("ROS_DOMAIN_ID", "97", 0);
  run("a node without a session", runs);
  latency::TracingSession session;
  session.start();
  setenv("LTTNG_UST_WITHOUT_BADDR_STATEDUMP", "1", 1);  // as in processes of the launcher
  run("a node that a session records", runs);
} catch (const std::exception& error) {
  fmt::print(stderr, "bench_node_start: {}\n", error.what());
  return EXIT_FAILURE;
}
