// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/spawn/stopped_threads.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/processes/process_stat.hpp"

namespace launch {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(1);

// 'T': stopped, 't': stopped by a debugger, 'Z' and 'X': ended. A thread that has gone has no name.
bool is_stopped(const ProcessStat& thread) {
  constexpr std::string_view kStopped = "TtZX";
  return thread.name.empty() || kStopped.find(thread.state) != std::string_view::npos;
}

bool threads_are_stopped(pid_t process) {
  std::error_code gone;
  std::filesystem::directory_iterator threads(fmt::format("/proc/{}/task", process), gone);
  while (!gone && threads != std::filesystem::directory_iterator()) {
    const std::string name = threads->path().filename();
    pid_t thread = 0;
    std::from_chars(name.data(), name.data() + name.size(), thread);
    if (!is_stopped(read_process_stat(thread))) {
      return false;
    }
    threads.increment(gone);
  }
  return true;
}

}  // namespace

bool wait_until_stopped(const std::vector<pid_t>& processes, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!std::all_of(processes.begin(), processes.end(), threads_are_stopped)) {
    if (std::chrono::steady_clock::now() >= end) {
      return false;
    }
    std::this_thread::sleep_for(kBetweenLooks);
  }
  return true;
}

}  // namespace launch
