// SPDX-License-Identifier: Apache-2.0
// Measures the cost of supervision: starts and stops N sleeping children in three ways, in turns in the same run.
// Prints medians and their ratios.
// - bare: posix_spawn(3), kill(2) and waitpid(2);
// - pipes: the same, each child with a process group, and pipes for its three streams, which are read to their ends and
//   closed. No launcher that gives its children input and logs their output can do less;
// - supervised: the supervisor on the real loop.
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/files/pipe.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "tests/benchmarks/samples/samples_file.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;

struct Times {
  double start = 0;  // microseconds for all children together
  double stop = 0;
};

// Returns when the child has started up and sleeps, so that the cost of its start doesn't count as part of its stop.
void wait_until_asleep(pid_t pid) {
  const std::string path = fmt::format("/proc/{}/syscall", pid);
  for (std::string number; number.empty() || number == "running" || number == "-1";) {
    std::ifstream(path) >> number;
    // clock_nanosleep, the only call in which /bin/sleep blocks.
    if (number != "230") {
      number.clear();
      ::sched_yield();
    }
  }
}

// What a child of the loops is started with.
struct Sleeper {
  std::array<char, 6> name{"sleep"};
  std::array<char, 5> duration{"1000"};
  std::array<char*, 3> argv{name.data(), duration.data(), nullptr};

  pid_t spawn(const posix_spawn_file_actions_t* actions = nullptr, const posix_spawnattr_t* attributes = nullptr) {
    pid_t pid = -1;
    if (::posix_spawn(&pid, "/bin/sleep", actions, attributes, argv.data(), environ) != 0) {
      throw std::runtime_error("cannot start /bin/sleep");
    }
    return pid;
  }
};

Times run_bare(std::size_t count) {
  Sleeper sleeper;
  std::vector<pid_t> pids(count);
  Times times;
  const auto start = Clock::now();
  for (pid_t& pid : pids) {
    pid = sleeper.spawn();
  }
  times.start = Microseconds(Clock::now() - start).count();
  std::for_each(pids.begin(), pids.end(), wait_until_asleep);
  const auto stop = Clock::now();
  for (const pid_t pid : pids) {
    ::kill(pid, SIGINT);
  }
  for (const pid_t pid : pids) {
    ::waitpid(pid, nullptr, 0);
  }
  times.stop = Microseconds(Clock::now() - stop).count();
  return times;
}

struct PipedChild {
  pid_t pid = -1;
  launch::UniqueFd in;
  std::array<launch::UniqueFd, 2> outputs;
};

PipedChild spawn_with_pipes(Sleeper& sleeper, const posix_spawnattr_t& own_group) {
  launch::Pipe in = launch::make_pipe();
  std::array<launch::Pipe, 2> outputs{launch::make_pipe(), launch::make_pipe()};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, in.read.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, outputs[0].write.get(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, outputs[1].write.get(), STDERR_FILENO);
  PipedChild child{sleeper.spawn(&actions, &own_group),
                   std::move(in.write),
                   {std::move(outputs[0].read), std::move(outputs[1].read)}};
  ::posix_spawn_file_actions_destroy(&actions);
  return child;
}

Times run_with_pipes(std::size_t count) {
  Sleeper sleeper;
  posix_spawnattr_t own_group;
  ::posix_spawnattr_init(&own_group);
  ::posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP);
  std::vector<PipedChild> children(count);
  Times times;
  const auto start = Clock::now();
  for (PipedChild& child : children) {
    child = spawn_with_pipes(sleeper, own_group);
  }
  times.start = Microseconds(Clock::now() - start).count();
  ::posix_spawnattr_destroy(&own_group);
  std::for_each(children.begin(), children.end(), [](const PipedChild& child) { wait_until_asleep(child.pid); });
  const auto stop = Clock::now();
  for (const PipedChild& child : children) {
    ::kill(-child.pid, SIGINT);
  }
  for (PipedChild& child : children) {
    for (launch::UniqueFd& output : child.outputs) {
      launch::read_to_end(output);
      output.reset();
    }
    ::waitpid(child.pid, nullptr, 0);
    child.in.reset();
  }
  times.stop = Microseconds(Clock::now() - stop).count();
  return times;
}

launch::ProcessSpec sleeper() {
  launch::ProcessSpec spec;
  spec.name = "sleep";
  spec.argv = {"/bin/sleep", "1000"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    spec.environment.emplace(std::string(text.substr(0, text.find('='))), std::string(text.substr(text.find('=') + 1)));
  }
  spec.output = *launch::OutputRouting::from_mode("log");
  return spec;
}

// The parts of a launcher that exist once.
struct Launcher {
  std::unique_ptr<launch::EventLoop> loop = launch::make_sd_event_loop();
  std::unique_ptr<launch::ProcessRunner> runner = launch::make_posix_process_runner();
  launch::OutputRouter output{{}};
};

Times run_supervised(Launcher& launcher, std::size_t count) {
  launch::ProcessSupervisor supervisor(*launcher.loop, *launcher.runner, launcher.output);
  std::vector<pid_t> pids;
  supervisor.observe([&](const launch::ProcessEvent& event) {
    if (const auto* started = std::get_if<launch::ProcessStarted>(&event.what)) {
      pids.push_back(started->pid);
    } else if (std::holds_alternative<launch::ProcessDone>(event.what) && supervisor.active() == 0) {
      launcher.loop->quit();
    }
  });
  const launch::ProcessSpec spec = sleeper();
  Times times;
  const auto start = Clock::now();
  for (std::size_t i = 0; i < count; ++i) {
    supervisor.start(spec);
  }
  times.start = Microseconds(Clock::now() - start).count();
  std::for_each(pids.begin(), pids.end(), wait_until_asleep);
  const auto stop = Clock::now();
  supervisor.shutdown();
  launcher.loop->run();
  times.stop = Microseconds(Clock::now() - stop).count();
  return times;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void measure(Launcher& launcher, std::size_t count, std::size_t rounds) {
  constexpr std::size_t kWays = 3;
  std::array<std::vector<double>, kWays> start;
  std::array<std::vector<double>, kWays> stop;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < kWays; ++turn) {
      const std::size_t which = (round + turn) % kWays;  // none always runs on the warmest machine
      const Times times = which == 0   ? run_bare(count)
                          : which == 1 ? run_with_pipes(count)
                                       : run_supervised(launcher, count);
      start[which].push_back(times.start / static_cast<double>(count));
      stop[which].push_back(times.stop / static_cast<double>(count));
    }
  }
  const auto row = [](const std::array<std::vector<double>, kWays>& values) {
    const double bare = median(values[0]);
    const double pipes = median(values[1]);
    const double supervised = median(values[2]);
    return fmt::format("{:>7.1f} {:>7.1f} {:>10.1f} {:>6.2f} {:>6.2f}", bare, pipes, supervised, supervised / bare,
                       supervised / pipes);
  };
  fmt::print("{:>8} | {} | {}\n", count, row(start), row(stop));
  const std::string children = fmt::format("{} {}, each", count, count == 1 ? "process" : "processes");
  benchmarks::report({children + " started", "us", start[2], "posix_spawn, kill, waitpid", start[0]});
  benchmarks::report({children + " ended", "us", stop[2], "posix_spawn, kill, waitpid", stop[0]});
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    Launcher launcher;
    run_supervised(launcher, 1);  // makes everything that is made on first need
    fmt::print("microseconds for each child; the ratios are supervised / bare and supervised / pipes\n");
    fmt::print("{:>8} | {:^40} | {:^40}\n", "", "start", "stop (SIGINT)");
    const std::string columns =
        fmt::format("{:>7} {:>7} {:>10} {:>6} {:>6}", "bare", "pipes", "supervised", "/bare", "/pipes");
    fmt::print("{:>8} | {} | {}\n", "children", columns, columns);
    measure(launcher, 1, 101);
    measure(launcher, 10, 31);
    measure(launcher, 100, 15);
    measure(launcher, 500, 7);
    measure(launcher, 2000, 5);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_spawn: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
