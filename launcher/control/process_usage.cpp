// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <array>

#include "launcher/base/unique_fd.hpp"

namespace launch {

// The clock of the process and statm take half as long as /proc/PID/stat, for which the kernel collects much more.
std::optional<ProcessUsage> read_process_usage(pid_t pid) {
  static const auto kPage = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  constexpr double kNanosecond = 1e-9;

  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) {
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

}  // namespace launch
