// SPDX-License-Identifier: Apache-2.0
#include "launcher/crash/core_search.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <thread>
#include <vector>

#include "launcher/crash/core_file.hpp"
#include "launcher/crash/timed_command.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// systemd-coredump hands a core over to a service, which stores it after the process is gone.
constexpr auto kStoredWithin = 10s;

std::string first_line(const char* path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string without_meaning(std::string_view text) {
  std::string quoted;
  for (const char character : text) {
    if (std::string_view("*?[\\").find(character) != std::string_view::npos) {
      quoted += '\\';
    }
    quoted += character;
  }
  return quoted;
}

std::vector<std::string> matches(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  ::globfree(&found);
  return paths;
}

// The newest of them that is of this process; a pattern without a number matches cores of others, too.
std::string newest_of(pid_t pid, const std::vector<std::string>& paths) {
  std::string newest;
  fs::file_time_type written;
  for (const std::string& path : paths) {
    std::error_code gone;
    const fs::file_time_type time = fs::last_write_time(path, gone);
    if (!gone && (newest.empty() || time > written)) {
      if (const auto core = read_core_file(path); core && core->pid == pid) {
        newest = path;
        written = time;
      }
    }
  }
  return newest;
}

FoundCore ask_coredumpctl(pid_t pid, const std::string& scratch) {
  const std::string core = scratch + "/core";
  const auto deadline = std::chrono::steady_clock::now() + kStoredWithin;
  for (;;) {
    const TimedCommand asked =
        run_timed({"coredumpctl", "dump", fmt::format("{}", pid), "-o", core}, "", kStoredWithin);
    if (!asked.started) {
      return {"", false, "systemd-coredump has the core, and coredumpctl is not installed (package systemd-coredump)"};
    }
    if (read_core_file(core)) {
      return {core, true, ""};
    }
    if (std::chrono::steady_clock::now() > deadline) {
      return {"", false,
              fmt::format("systemd-coredump has got the core, and `coredumpctl dump {}` does not find it", pid)};
    }
    std::this_thread::sleep_for(200ms);  // coredumpctl can't wait for a core that is still being stored
  }
}

}  // namespace

CoreSetting CoreSetting::of_kernel() {
  return {first_line("/proc/sys/kernel/core_pattern"), first_line("/proc/sys/kernel/core_uses_pid") == "1"};
}

std::string CoreSetting::program() const {
  const std::size_t begin = pattern.find_first_not_of("| ");
  return is_program() && begin != std::string::npos ? pattern.substr(begin, pattern.find(' ', begin) - begin) : "";
}

std::string CoreSetting::glob(pid_t pid, const std::string& directory) const {
  std::string text;
  bool has_pid = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      text += without_meaning(pattern.substr(i, 1));
    } else if (++i < pattern.size()) {
      has_pid |= pattern[i] == 'p';
      text += pattern[i] == 'p' ? fmt::format("{}", pid) : pattern[i] == '%' ? "%" : "*";
    }
  }
  if (adds_pid && !has_pid) {
    text += fmt::format(".{}", pid);
  }
  return text.starts_with('/') ? text : without_meaning(directory) + "/" + text;
}

FoundCore find_core(const CoreSetting& setting, pid_t pid, const std::string& directory, const std::string& scratch) {
  if (setting.is_program()) {
    const std::string program = setting.program();
    const std::string name = fs::path(program).filename().string();
    if (name == "systemd-coredump") {
      return ask_coredumpctl(pid, scratch);
    }
    // Apport keeps cores of programs that no package holds here, with the number of the process in their names.
    if (const std::string core = newest_of(pid, matches(fmt::format("/var/lib/apport/coredump/core.*.{}.*", pid)));
        name == "apport" && !core.empty()) {
      return {core, false, ""};
    }
    return {
        "", false,
        fmt::format("the kernel gives cores to '{}', which is not asked for them; `sysctl kernel.core_pattern=core.%p` "
                    "makes them files",
                    program)};
  }
  const std::string pattern = setting.glob(pid, directory);
  const std::string core = newest_of(pid, matches(pattern));
  return core.empty() ? FoundCore{"", false,
                                  fmt::format("there is no core of process {} at {} (kernel.core_pattern is '{}')", pid,
                                              pattern, setting.pattern)}
                      : FoundCore{core, false, ""};
}

}  // namespace launch
