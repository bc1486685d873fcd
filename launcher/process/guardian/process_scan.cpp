// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/guardian/process_scan.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

#include "base/files/unique_fd.hpp"
#include "base/processes/process_mark.hpp"

namespace launch {
namespace {

constexpr unsigned kExiting = 0x4;  // PF_EXITING of the kernel, in the flags of /proc/PID/stat

// The part before the next colon, which is removed together with the colon.
std::string_view next_part(std::string_view& text) {
  const std::size_t end = std::min(text.find(':'), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

std::int64_t timeout(std::string_view text) {
  constexpr std::int64_t kYear = 365LL * 24 * 3600 * 1000;
  return std::clamp<std::int64_t>(std::atoll(std::string(text).c_str()), 0, kYear);
}

// In the middle of an exec a process seems to have neither arguments nor an environment. Nothing tells when it has
// them.
std::string read_environment(const FoundProcess& process) {
  constexpr std::chrono::milliseconds kLongestExec{20};
  const auto end = std::chrono::steady_clock::now() + kLongestExec;
  while (true) {
    std::string environment = read_whole_file(proc_directory(process) + "/environ");
    std::array<char, 1> path{};
    const bool has_program = ::readlink((proc_directory(process) + "/exe").c_str(), path.data(), path.size()) > 0;
    if (!environment.empty() || !has_program || !read_proc_file(process.pid, "cmdline").empty() ||
        std::chrono::steady_clock::now() > end) {
      return environment;
    }
    ::sched_yield();
  }
}

void read_mark_value(std::string_view value, const std::string& launch_id, ProcessMark& mark) {
  if (next_part(value) != launch_id) {
    return;
  }
  mark.ours = true;
  mark.sigterm_timeout = timeout(next_part(value));
  mark.sigkill_timeout = timeout(next_part(value));
  const std::string_view screen = next_part(value);
  mark.out_on_screen = screen.find('o') != std::string_view::npos;
  mark.error_on_screen = screen.find('e') != std::string_view::npos;
  mark.label = value;
}

}  // namespace

// From /proc/PID/stat, proc(5): "pid (name) state ppid pgrp session tty tpgid flags … starttime …".
std::optional<FoundProcess> read_process(pid_t pid) {
  constexpr int kFieldOfThreads = 17;  // counted from the state, which is 0
  constexpr int kFieldOfStart = 19;
  const std::string text = read_proc_file(pid, "stat");
  const std::size_t open = text.find('(');
  const std::size_t close = text.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 2 >= text.size()) {
    return std::nullopt;
  }
  FoundProcess process;
  process.pid = pid;
  process.name = text.substr(open + 1, close - open - 1);
  const char* next = text.c_str() + close + 2;
  process.state = *next;
  for (int field = 0; field <= kFieldOfStart && next != nullptr; ++field) {
    const std::uint64_t value = std::strtoull(next, nullptr, 10);
    if (field == 1) {
      process.parent = static_cast<pid_t>(value);
    } else if (field == 2) {
      process.group = static_cast<pid_t>(value);
    } else if (field == 3) {
      process.session = static_cast<pid_t>(value);
    } else if (field == 6) {
      process.dying = (value & kExiting) != 0;
    } else if (field == kFieldOfThreads) {
      process.threads = static_cast<long>(value);
    } else if (field == kFieldOfStart) {
      process.started = value;
    }
    next = std::strchr(next, ' ');
    next = next == nullptr ? nullptr : next + 1;
  }
  process.dying = process.dying && process.threads <= 1;  // the flag is that of the main thread
  return process;
}

std::string proc_directory(const FoundProcess& process) {
  const std::string path = "/proc/" + std::to_string(process.pid);
  if (process.state != 'Z' || process.threads <= 1) {
    return path;
  }
  std::string living;
  if (DIR* const directory = ::opendir((path + "/task").c_str())) {
    while (const dirent* const entry = ::readdir(directory)) {
      if (const int thread = std::atoi(entry->d_name); thread > 0 && thread != process.pid) {
        living = path + "/task/" + entry->d_name;
      }
    }
    ::closedir(directory);
  }
  return living.empty() ? path : living;
}

std::string read_proc_file(pid_t pid, const char* name) {
  return read_whole_file("/proc/" + std::to_string(pid) + "/" + name);
}

std::string read_whole_file(const std::string& path) {
  const UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string text;
  while (fd) {
    const std::size_t size = text.size();
    text.resize(size + 4096);
    const ssize_t count = ::read(fd.get(), text.data() + size, 4096);
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0 || (count < 0 && errno != EINTR)) {
      break;
    }
  }
  return text;
}

std::vector<FoundProcess> all_processes() {
  std::vector<FoundProcess> all;
  DIR* const directory = ::opendir("/proc");
  if (directory == nullptr) {
    return all;
  }
  while (const dirent* const entry = ::readdir(directory)) {
    const int pid = std::atoi(entry->d_name);
    if (pid > 0) {
      if (std::optional<FoundProcess> process = read_process(pid)) {
        all.push_back(std::move(*process));
      }
    }
  }
  ::closedir(directory);
  return all;
}

bool has_children() {
  siginfo_t info{};
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

std::optional<std::set<pid_t>> children_of(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children";
  const std::string text = read_whole_file(path);
  if (text.empty() && ::access(path.c_str(), R_OK) != 0) {
    return std::nullopt;
  }
  std::set<pid_t> children;
  for (const char* next = text.c_str(); *next != '\0';) {
    char* end = nullptr;
    children.insert(static_cast<pid_t>(std::strtol(next, &end, 10)));
    next = *end == ' ' ? end + 1 : end;
  }
  return children;
}

std::vector<FoundProcess> descendants(const std::vector<FoundProcess>& all, const std::set<pid_t>& roots) {
  std::set<pid_t> known = roots;
  std::vector<FoundProcess> found;
  // A child can have a smaller number than its parent, so one pass is not always enough.
  for (bool more = true; more;) {
    more = false;
    for (const FoundProcess& process : all) {
      if (known.count(process.parent) != 0 && known.insert(process.pid).second) {
        found.push_back(process);
        more = true;
      }
    }
  }
  return found;
}

ProcessMark read_mark(const FoundProcess& process, const std::string& launch_id) {
  ProcessMark mark;
  const std::string environment = read_environment(process);
  const std::string mark_name = std::string(kMarkVariable) + "=";
  const std::string leave_name = std::string(kLeaveRunningVariable) + "=";
  for (std::string_view rest = environment; !rest.empty();) {
    const std::string_view variable = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(variable.size() + 1, rest.size()));
    if (variable.substr(0, mark_name.size()) == mark_name) {
      read_mark_value(variable.substr(mark_name.size()), launch_id, mark);
    } else if (variable.substr(0, leave_name.size()) == leave_name) {
      mark.leave_running = variable.size() > leave_name.size();
    }
  }
  return mark;
}

bool is_guardian(const FoundProcess& process, const std::string& launch_id) {
  return (process.name == "guardian-spare" || process.name == "launch-guardian") &&
         read_proc_file(process.pid, "cmdline").find('\0' + launch_id + '\0') != std::string::npos;
}

bool is_being_killed(pid_t pid) {
  constexpr std::uint64_t kKill = 1ULL << (SIGKILL - 1);
  const std::string status = read_proc_file(pid, "status");
  for (const char* const line : {"\nSigPnd:\t", "\nShdPnd:\t"}) {
    const std::size_t at = status.find(line);
    if (at != std::string::npos && (std::strtoull(status.c_str() + at + std::strlen(line), nullptr, 16) & kKill) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace launch
