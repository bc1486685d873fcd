// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/consumer_priority.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/small_file.hpp"
#include "base/processes/process_stat.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConsumer = "lttng-consumerd";
constexpr const char* kSessionDaemon = "lttng-sessiond";

pid_t number_of(const fs::path& path) {
  const std::string name = path.filename();
  pid_t number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

bool is_consumer_of(const fs::path& process, pid_t daemon) {
  const launch::ProcessStat stat = launch::read_process_stat(number_of(process));
  return stat.name == kConsumer && stat.parent == daemon;
}

// The children of a process. All processes are looked at where the kernel doesn't list them (CONFIG_PROC_CHILDREN),
// which takes milliseconds.
std::vector<fs::path> candidates(pid_t daemon) {
  std::vector<fs::path> found;
  std::error_code none;
  bool listed = false;
  for (const fs::directory_entry& thread : fs::directory_iterator(fmt::format("/proc/{}/task", daemon), none)) {
    const std::optional<std::string> children = launch::read_small_file(thread.path() / "children");
    listed = listed || children.has_value();
    for (std::string_view rest = children ? std::string_view(*children) : std::string_view(); !rest.empty();) {
      const std::size_t end = rest.find(' ');
      found.push_back(fs::path("/proc") / rest.substr(0, end));
      rest.remove_prefix(std::min(end, rest.size() - 1) + 1);
    }
  }
  if (listed) {
    return found;
  }
  for (const fs::directory_entry& process : fs::directory_iterator("/proc", none)) {
    if (number_of(process.path()) > 0) {
      found.push_back(process.path());
    }
  }
  return found;
}

// The error of the first thread that keeps its priority, or 0. On Linux a nice value belongs to a thread, and new
// threads have that of their maker. The main thread is the last to get it: if it has it, all have.
int prefer(const fs::path& process) {
  const pid_t main_thread = number_of(process);
  if (getpriority(PRIO_PROCESS, static_cast<id_t>(main_thread)) == kConsumerNice) {
    return 0;
  }
  const auto prefer_thread = [](pid_t thread) {
    const bool done = setpriority(PRIO_PROCESS, static_cast<id_t>(thread), kConsumerNice) == 0;
    return done || errno == ESRCH ? 0 : errno;
  };
  std::error_code none;
  for (const fs::directory_entry& thread : fs::directory_iterator(process / "task", none)) {
    const pid_t id = number_of(thread.path());
    if (const int error = id == main_thread ? 0 : prefer_thread(id); error != 0) {
      return error;
    }
  }
  return prefer_thread(main_thread);
}

}  // namespace

std::vector<pid_t> consumers_of(pid_t daemon) {
  std::vector<pid_t> consumers;
  for (const fs::path& process : candidates(daemon)) {
    if (is_consumer_of(process, daemon)) {
      consumers.push_back(number_of(process));
    }
  }
  return consumers;
}

std::vector<pid_t> file_makers_of(pid_t daemon) {
  std::vector<pid_t> makers;
  const bool has_consumers = launch::read_process_stat(daemon).name == kSessionDaemon;
  for (const fs::path& process : candidates(daemon)) {
    // A new one has the name of its parent for a moment.
    const launch::ProcessStat stat = launch::read_process_stat(number_of(process));
    if (stat.parent == daemon && stat.name.starts_with("lttng-") && !(has_consumers && stat.name == kConsumer)) {
      makers.push_back(number_of(process));
    }
  }
  return makers;
}

std::string prefer_daemons(pid_t daemon) {
  if (launch::read_process_stat(daemon).name == kSessionDaemon) {
    prefer(fmt::format("/proc/{}", daemon));
  }
  for (const pid_t consumer : consumers_of(daemon)) {
    const int error = prefer(fmt::format("/proc/{}", consumer));
    if (error == 0) {
      continue;
    }
    return fmt::format(
        "LTTng's consumer keeps its priority ({}): on a machine that is busy all the time it may come too late, and "
        "events are lost; it takes root, CAP_SYS_NICE, or `USER - nice {}` in /etc/security/limits.conf",
        std::strerror(error), kConsumerNice);
  }
  return {};
}

}  // namespace tracing
