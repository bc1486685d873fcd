// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/processor_wait.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

namespace launch {
namespace {

std::string task(const std::string& proc, pid_t pid, pid_t tid, const char* file) {
  return fmt::format("{}/{}/task/{}/{}", proc, pid, tid, file);
}

}  // namespace

char state_of_thread(pid_t pid, pid_t tid, const std::string& proc) {
  std::ifstream file(task(proc, pid, tid, "stat"));
  std::string text;
  std::getline(file, text);
  // The name of the program is in parentheses, and may hold some.
  const std::size_t end_of_name = text.rfind(')');
  return end_of_name == std::string::npos || end_of_name + 2 >= text.size() ? '?' : text[end_of_name + 2];
}

Duration ProcessorWait::of_thread(pid_t pid, pid_t tid, Duration passed) {
  std::ifstream file(task(proc_, pid, tid, "schedstat"));
  std::int64_t ran = 0;
  std::int64_t waited = 0;
  if (!(file >> ran >> waited)) {
    return Duration{0};
  }
  const Seen now{Duration(ran), Duration(waited)};
  const auto [found, is_new] = seen_.emplace(tid, now);
  if (is_new) {
    return Duration{0};
  }
  const Seen before = std::exchange(found->second, now);
  if (now.ran == before.ran && now.waited == before.waited && state_of_thread(pid, tid, proc_) == 'R') {
    return passed;  // the kernel adds a wait when it ends
  }
  return std::clamp(now.waited - before.waited, Duration{0}, passed);
}

Duration ProcessorWait::of_process(pid_t pid, Duration passed) {
  Duration longest{0};
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator(fmt::format("{}/{}/task", proc_, pid), gone)) {
    const std::string name = entry.path().filename().string();
    pid_t tid = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), tid).ec == std::errc()) {
      longest = std::max(longest, of_thread(pid, tid, passed));
    }
  }
  return longest;
}

}  // namespace launch
