// SPDX-License-Identifier: Apache-2.0
#include "context/introduction.hpp"

#include <fstream>
#include <string>
#include <utility>

namespace rmw_fastrtps {

Introduction::Introduction(Clock::time_point now, std::function<bool()> is_thread_busy)
    : next_(now + kMoment), latest_(now + kLongest), is_thread_busy_(std::move(is_thread_busy)) {}

bool Introduction::is_due(Clock::time_point now) {
  if (now < next_) {
    return false;
  }
  if (now < latest_ && is_thread_busy_()) {
    put_off(now);
    return false;
  }
  return true;
}

bool is_busy(pid_t thread) {
  // proc(5): the state follows the name, which is in parentheses and may hold any character.
  std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(") ");
  if (name_end == std::string::npos) {
    return false;
  }
  const char state = line[name_end + 2];
  return state == 'R' || state == 'D';
}

}  // namespace rmw_fastrtps
