// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <thread>

#include "launcher/base/files/unique_fd.hpp"

namespace launch {

namespace {

// A thread takes as long to start as a dozen processes to be looked at.
constexpr std::size_t kWorthAThread = 200;
constexpr std::size_t kMostThreads = 4;

// As clock_getcpuclockid(3), which asks the kernel whether there is such a process: so does the reading of the clock.
clockid_t clock_of(pid_t pid) {
  constexpr clockid_t kAllThreadsScheduled = 2;  // CPUCLOCK_SCHED of the kernel
  return static_cast<clockid_t>(~static_cast<unsigned>(pid) << 3U) | kAllThreadsScheduled;
}

}  // namespace

// The clock of the process and statm take half as long as /proc/PID/stat, for which the kernel collects much more.
std::optional<ProcessUsage> read_process_usage(pid_t pid) {
  static const auto kPage = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  constexpr double kNanosecond = 1e-9;

  timespec used{};
  if (pid <= 0 || ::clock_gettime(clock_of(pid), &used) != 0) {
    return std::nullopt;
  }
  std::array<char, 32> path{};
  ::snprintf(path.data(), path.size(), "/proc/%d/statm", pid);
  const UniqueFd file(::open(path.data(), O_RDONLY | O_CLOEXEC));
  std::array<char, 256> text;  // not initialised: it is read into
  const ssize_t size = file ? ::read(file.get(), text.data(), text.size() - 1) : -1;
  if (size <= 0) {
    return std::nullopt;
  }
  text[static_cast<std::size_t>(size)] = '\0';
  const char* const resident = ::strchr(text.data(), ' ');  // "size resident …", in pages
  ProcessUsage usage;
  usage.cpu = static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * kNanosecond;
  usage.memory = resident == nullptr ? 0 : ::strtoull(resident, nullptr, 10) * kPage;
  return usage;
}

std::vector<std::optional<ProcessUsage>> read_process_usage(const std::vector<pid_t>& pids) {
  std::vector<std::optional<ProcessUsage>> all(pids.size());
  const std::size_t processors = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
  const std::size_t threads = std::clamp<std::size_t>(pids.size() / kWorthAThread, 1, processors);
  const std::size_t share = (pids.size() + threads - 1) / threads;
  const auto read = [&](std::size_t thread) {
    for (std::size_t i = thread * share; i < std::min((thread + 1) * share, pids.size()); ++i) {
      all[i] = read_process_usage(pids[i]);
    }
  };
  std::vector<std::jthread> others;
  for (std::size_t thread = 1; thread < threads; ++thread) {
    others.emplace_back(read, thread);
  }
  read(0);
  others.clear();  // waits for them
  return all;
}

}  // namespace launch
