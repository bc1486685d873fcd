// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/control_groups/kernel_messages.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>

#include "base/files/unique_fd.hpp"

namespace launch {

bool tells_of_end(std::string_view record, pid_t pid, std::chrono::nanoseconds since) {
  const std::size_t text = record.find(';');
  std::size_t time = 0;
  for (int comma = 0; comma < 2 && time != std::string_view::npos; ++comma) {
    time = record.find(',', time);
    time = time == std::string_view::npos ? time : time + 1;
  }
  if (text == std::string_view::npos || time == std::string_view::npos || time > text) {
    return false;
  }
  std::int64_t microseconds = 0;
  std::from_chars(record.data() + time, record.data() + text, microseconds);
  const std::string sign = "Killed process " + std::to_string(pid) + " ";
  // The clock of the log runs a little faster or slower.
  constexpr std::chrono::minutes kDrift{1};
  return std::chrono::microseconds(microseconds) + kDrift >= since && record.find(sign, text) != std::string_view::npos;
}

bool ended_for_want_of_memory(pid_t pid, std::chrono::nanoseconds since, const std::string& log) {
  const UniqueFd file(::open(log.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  std::array<char, 8192> record{};  // each read(2) gives one
  while (file) {
    const ssize_t size = ::read(file.get(), record.data(), record.size());
    if (size > 0) {
      if (tells_of_end({record.data(), static_cast<std::size_t>(size)}, pid, since)) {
        return true;
      }
    } else if (size == 0 || (errno != EPIPE && errno != EINTR)) {  // EPIPE: records were overwritten meanwhile
      return false;
    }
  }
  return false;
}

}  // namespace launch
