// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/checks/unreachable_processes.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_list.hpp"
#include "tracing/record/lttng/session_daemon.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

std::set<int> registered_processes() {
  const DomainHandle handle = domain_handle("", LTTNG_DOMAIN_UST);
  const LttngList<lttng_event> events("list the userspace events", lttng_list_tracepoints, handle.get());
  std::set<int> pids;
  for (const lttng_event& event : events) {
    pids.insert(event.pid);
  }
  return pids;
}

// Which directory that is; nothing when it can't be seen.
std::optional<std::pair<dev_t, ino_t>> identity_of(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return std::pair{status.st_dev, status.st_ino};
}

// In ticks after the machine's start, field 22 of proc(5)'s stat; nothing when it can't be seen.
std::optional<std::uint64_t> start_time(const fs::path& process) {
  std::string line;
  std::getline(std::ifstream(process / "stat"), line);
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) {
    return std::nullopt;
  }
  std::istringstream fields(line.substr(name_end + 1));
  std::string passed;
  for (int field = 3; field < 22; ++field) {
    fields >> passed;
  }
  std::uint64_t ticks = 0;
  return fields >> ticks ? std::optional(ticks) : std::nullopt;
}

bool has_lttng_ust(const fs::path& process) {
  std::ifstream maps(process / "maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("/liblttng-ust.so") != std::string::npos) {
      return true;
    }
  }
  return false;
}

int number_of(const fs::path& path) {
  const std::string name = path.filename();
  int number = 0;
  const auto end = std::from_chars(name.data(), name.data() + name.size(), number).ptr;
  return end == name.data() + name.size() ? number : 0;
}

}  // namespace

std::vector<std::string> unreachable_process_warnings() {
  std::vector<std::string> warnings;
  const fs::path daemon = session_daemon_directory();
  const auto memory = identity_of("/dev/shm");
  const auto directory = identity_of(daemon);
  const auto daemon_started = start_time(fs::path("/proc") / std::to_string(session_daemon_pid()));
  std::optional<std::set<int>> registered;  // asked for only when some process is suspected
  std::error_code none;
  for (const fs::directory_entry& process : fs::directory_iterator("/proc", none)) {
    const int pid = number_of(process.path());
    if (pid <= 0) {
      continue;
    }
    const fs::path root = process.path() / "root";
    const auto theirs = identity_of(root / "dev" / "shm");
    if (!theirs || theirs == memory || identity_of(root / daemon.relative_path()) != directory) {
      continue;
    }
    // What starts later finds the daemon by itself.
    const auto started = start_time(process.path());
    if (!started || !daemon_started || *started > *daemon_started) {
      continue;
    }
    if (!has_lttng_ust(process.path())) {
      continue;
    }
    if (!registered) {
      registered = registered_processes();
    }
    if (registered->contains(pid)) {
      continue;
    }
    std::string name;
    std::getline(std::ifstream(process.path() / "comm"), name);
    warnings.push_back(
        fmt::format("process {} ({}) is not recorded: it has a /dev/shm of its own and started before the session "
                    "daemon; share /dev/shm (docker run --ipc=host), or start it again",
                    pid, name));
  }
  return warnings;
}

}  // namespace tracing
