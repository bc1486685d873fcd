// SPDX-License-Identifier: Apache-2.0
// Usage: bench_trace_load [NODES [EVENTS_PER_SECOND [SECONDS [SUBBUFFER_SIZE SUBBUFFER_COUNT READ_TIMER [URL]]]]]
//
// Checks whether the default buffers are large enough. NODES processes fire first the events of their creation all at
// once, then EVENTS_PER_SECOND together. All are recorded with the three context fields. With a URL the trace goes to a
// relay daemon.
#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

extern char** environ;  // NOLINT: POSIX names it so

namespace {

namespace fs = std::filesystem;
using Milliseconds = std::chrono::duration<double, std::milli>;

struct Load {
  int nodes = 100;
  long events_per_second = 200'000;
  int seconds = 60;
};

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "bench_trace_load: {}\n", what);
  std::exit(1);
}

template <typename Work>
double milliseconds_of(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return Milliseconds(std::chrono::steady_clock::now() - begin).count();
}

// Makes a session daemon of our own: root has one in /run, other users have one in LTTNG_HOME.
void isolate(const fs::path& directory) {
  setenv("LTTNG_HOME", directory.c_str(), 1);
  if (geteuid() == 0 && (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
                         mount("tmpfs", "/run", "tmpfs", 0, "mode=1777") != 0)) {
    fail("no mount namespace of its own");
  }
}

// The process with this name; zero when there is none. Names end after 15 characters.
pid_t process_named(const std::string& name) {
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::string found;
    std::error_code ended;  // the process may be gone meanwhile
    if (std::getline(std::ifstream(entry.path() / "comm"), found) && found == name &&
        fs::read_symlink(entry.path() / "ns" / "mnt", ended) == fs::read_symlink("/proc/self/ns/mnt")) {
      return std::stoi(entry.path().filename());
    }
  }
  return 0;
}

// Processor time that the process has used, in seconds (proc(5), fields 14 and 15 of stat).
double cpu_seconds(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string word;
  double ticks = 0;
  for (int field = 1; file >> word; ++field) {
    if (field == 14 || field == 15) {
      ticks += std::stod(word);
    }
  }
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// Starts all nodes at once. When the last one has ended, returns how many events they fired.
long run_nodes(const Load& load, int seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    fail("no pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  std::string rate = std::to_string(load.events_per_second / load.nodes);
  std::string duration = std::to_string(seconds);
  std::string program = TRACED_NODE_PROGRAM;
  for (int i = 0; i < load.nodes; ++i) {
    char* const argv[] = {program.data(), rate.data(), duration.data(), nullptr};
    pid_t pid = -1;
    if (posix_spawn(&pid, argv[0], &actions, nullptr, argv, environ) != 0) {
      fail("cannot start " + program);
    }
  }
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  long fired = 0;
  FILE* const answers = fdopen(ends[0], "r");
  for (long count = 0; std::fscanf(answers, "%ld", &count) == 1;) {
    fired += count;
  }
  std::fclose(answers);
  for (int i = 0; i < load.nodes; ++i) {
    int status = 0;
    wait(&status);
  }
  return fired;
}

struct Bench {
  Load load;
  tracing::TraceConfig config;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();

  double begin(const std::string& name) {
    // Several of these programs may send to one relay daemon.
    config.session_name = config.url.empty() ? name : fmt::format("{}-{}", name, getpid());
    return milliseconds_of([this] { tracer->start(config); });
  }

  double end(tracing::LossAccount& losses) {
    return milliseconds_of([&] { losses = tracer->finish(config, [] { return false; }); });
  }

  void record(const std::string& name, const std::string& what, int seconds) {
    begin(name);
    const pid_t consumer = process_named("lttng-consumerd");
    const double cpu_before = cpu_seconds(consumer);
    const auto began = std::chrono::steady_clock::now();
    const long fired = run_nodes(load, seconds);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const double cpu = cpu_seconds(consumer) - cpu_before;
    tracing::LossAccount losses;
    const double ended = end(losses);
    fmt::print("{}: {} nodes, {} events in {:.1f} s ({:.0f} per second)\n", what, load.nodes, fired, took,
               static_cast<double>(fired) / took);
    fmt::print("  lost                               {:8}\n", losses.discarded_events());
    fmt::print("  consumer, of one processor         {:8.1f} %\n", 100 * cpu / took);
    fmt::print("  end, after the last node           {:8.1f} ms\n", ended);
    const std::string buffers = fmt::format("{} events/s, {} x {} KiB", load.events_per_second,
                                            config.ust.subbuffer_count, config.ust.subbuffer_size / 1024);
    if (seconds > 0) {
      benchmarks::report({buffers + ", lost",
                          "%",
                          {100 * static_cast<double>(losses.discarded_events()) / static_cast<double>(fired)}});
      benchmarks::report({buffers + ", consumer", "% of a processor", {100 * cpu / took}});
    }
    if (config.url.empty()) {
      fs::remove_all(config.trace_directory());
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  Bench bench;
  const auto argument = [&](int index, auto& value) {
    if (argc > index) {
      value = static_cast<std::remove_reference_t<decltype(value)>>(std::atol(argv[index]));
    }
  };
  argument(1, bench.load.nodes);
  argument(2, bench.load.events_per_second);
  argument(3, bench.load.seconds);
  argument(4, bench.config.ust.subbuffer_size);
  argument(5, bench.config.ust.subbuffer_count);
  argument(6, bench.config.ust.read_timer);
  if (argc > 7) {
    bench.config.url = argv[7];
  }
  std::string directory = (fs::temp_directory_path() / "bench_trace_load-XXXXXX").string();
  if (mkdtemp(directory.data()) == nullptr) {
    fail("cannot create " + directory);
  }
  isolate(directory);
  bench.config.base_path = directory;
  try {
    bench.record("startup", "start-up", 0);
    bench.record("load", "load", bench.load.seconds);
  } catch (const tracing::TraceError& error) {
    fail(error.what());
  }
  kill(process_named("lttng-sessiond"), SIGTERM);
  fs::remove_all(directory);
}
