// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/process_usage.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <array>

#include "launcher/base/unique_fd.hpp"

namespace launch {

// "pid (name) state parent …", and the name may hold anything. Fields are counted from 1, as proc(5) does.
std::optional<ProcessUsage> read_process_usage(pid_t pid) {
  constexpr int kState = 3;
  constexpr int kUserTime = 14;
  constexpr int kSystemTime = 15;
  constexpr int kResident = 24;
  static const double kTick = 1.0 / static_cast<double>(::sysconf(_SC_CLK_TCK));
  static const auto kPage = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));

  std::array<char, 32> path{};
  ::snprintf(path.data(), path.size(), "/proc/%d/stat", pid);
  const UniqueFd file(::open(path.data(), O_RDONLY | O_CLOEXEC));
  std::array<char, 1024> text;  // not initialised: it is read into
  const ssize_t size = file ? ::read(file.get(), text.data(), text.size() - 1) : -1;
  if (size <= 0) {
    return std::nullopt;
  }
  text[static_cast<std::size_t>(size)] = '\0';
  const char* field = ::strrchr(text.data(), ')');
  if (field == nullptr || field[1] == '\0') {
    return std::nullopt;
  }
  ++field;
  ProcessUsage usage;
  for (int number = kState; number <= kResident && field != nullptr; ++number) {
    ++field;
    if (number == kUserTime || number == kSystemTime) {
      usage.cpu += static_cast<double>(::strtoull(field, nullptr, 10)) * kTick;
    } else if (number == kResident) {
      usage.memory = ::strtoull(field, nullptr, 10) * kPage;
    }
    field = ::strchr(field, ' ');
  }
  return usage;
}

}  // namespace launch
