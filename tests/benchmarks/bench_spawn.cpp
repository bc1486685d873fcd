// SPDX-License-Identifier: Apache-2.0
// Measures the cost of supervision: starts and stops N sleeping children with the supervisor on the real loop, and with
// bare posix_spawn(3), kill(2) and waitpid(2), in turns in the same run. Prints medians and their ratios.
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
#include <vector>

#include "launcher/process/process_supervisor.hpp"

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

Times run_bare(std::size_t count) {
  std::array<char, 6> name{"sleep"};
  std::array<char, 5> duration{"1000"};
  const std::array<char*, 3> argv{name.data(), duration.data(), nullptr};
  std::vector<pid_t> pids(count);
  Times times;
  const auto start = Clock::now();
  for (pid_t& pid : pids) {
    if (::posix_spawn(&pid, "/bin/sleep", nullptr, nullptr, argv.data(), environ) != 0) {
      throw std::runtime_error("cannot start /bin/sleep");
    }
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
  std::array<std::vector<double>, 2> start;
  std::array<std::vector<double>, 2> stop;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < 2; ++turn) {
      const std::size_t which = (round + turn) % 2;  // neither always runs on the warmer machine
      const Times times = which == 0 ? run_bare(count) : run_supervised(launcher, count);
      start[which].push_back(times.start / static_cast<double>(count));
      stop[which].push_back(times.stop / static_cast<double>(count));
    }
  }
  const auto row = [](const std::array<std::vector<double>, 2>& values) {
    const double bare = median(values[0]);
    const double supervised = median(values[1]);
    return fmt::format("{:>9.1f} {:>11.1f} {:>7.2f}", bare, supervised, supervised / bare);
  };
  fmt::print("{:>9} | {} | {}\n", count, row(start), row(stop));
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    Launcher launcher;
    run_supervised(launcher, 1);  // makes everything that is made on first need
    fmt::print("microseconds for each child; ratio = supervised / bare\n");
    fmt::print("{:>9} | {:^29} | {:^29}\n", "", "start", "stop (SIGINT)");
    fmt::print("{:>9} | {:>9} {:>11} {:>7} | {:>9} {:>11} {:>7}\n", "children", "bare", "supervised", "ratio", "bare",
               "supervised", "ratio");
    measure(launcher, 1, 101);
    measure(launcher, 10, 31);
    measure(launcher, 100, 15);
    measure(launcher, 500, 7);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_spawn: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
