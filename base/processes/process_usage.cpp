// SPDX-License-Identifier: Apache-2.0
#include "base/processes/process_usage.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cstddef>

#include "base/files/unique_fd.hpp"

namespace launch {

namespace {

// As clock_getcpuclockid(3), which asks the kernel whether there is such a process: so does the reading of the clock.
clockid_t clock_of(pid_t pid) {
  constexpr clockid_t kAllThreadsScheduled = 2;  // CPUCLOCK_SCHED of the kernel
  return static_cast<clockid_t>(~static_cast<unsigned>(pid) << 3U) | kAllThreadsScheduled;
}

}  // namespace

// The times in /proc/PID/stat are whole ticks, so the clock of the process tells the time.
std::optional<ProcessUsage> read_process_usage(pid_t pid) {
  static const auto kPage = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  constexpr double kNanosecond = 1e-9;

  timespec used{};
  if (pid <= 0 || ::clock_gettime(clock_of(pid), &used) != 0) {
    return std::nullopt;
  }
  std::array<char, 32> path{};
  ::snprintf(path.data(), path.size(), "/proc/%d/stat", pid);
  const UniqueFd file(::open(path.data(), O_RDONLY | O_CLOEXEC));
  std::array<char, 1024> text;  // not initialised: it is read into
  const ssize_t size = file ? ::read(file.get(), text.data(), text.size() - 1) : -1;
  if (size <= 0) {
    return std::nullopt;
  }
  text[static_cast<std::size_t>(size)] = '\0';
  // "pid (name) state …", and the name may have brackets and spaces. The pages that are resident are field 21 from
  // there.
  constexpr int kFieldOfPages = 21;
  const char* const name_end = ::strrchr(text.data(), ')');
  if (name_end == nullptr || name_end[1] == '\0') {
    return std::nullopt;
  }
  const char* resident = name_end + 2;
  const char state = *resident;
  for (int field = 0; field < kFieldOfPages && resident != nullptr; ++field) {
    resident = ::strchr(resident, ' ');
    resident = resident == nullptr ? nullptr : resident + 1;
  }
  ProcessUsage usage;
  usage.stopped = state == 'T' || state == 't';
  usage.cpu = static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * kNanosecond;
  usage.memory = resident == nullptr ? 0 : ::strtoull(resident, nullptr, 10) * kPage;
  return usage;
}

}  // namespace launch
