// SPDX-License-Identifier: Apache-2.0
#include "tracing/lttng/consumer_priority.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tracing/lttng/process_stat.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConsumer = "lttng-consumerd";

pid_t number_of(const fs::path& path) {
  const std::string name = path.filename();
  pid_t number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

bool is_consumer_of(const fs::path& process, pid_t daemon) {
  const ProcessStat stat = read_process_stat(number_of(process));
  return stat.name == kConsumer && stat.parent == daemon;
}

// The children of a process. All processes are looked at where the kernel doesn't list them (CONFIG_PROC_CHILDREN),
// which takes milliseconds.
std::vector<fs::path> candidates(pid_t daemon) {
  std::vector<fs::path> found;
  std::error_code none;
  bool listed = false;
  for (const fs::directory_entry& thread : fs::directory_iterator(fmt::format("/proc/{}/task", daemon), none)) {
    std::ifstream children(thread.path() / "children");
    listed = listed || children.is_open();
    for (pid_t child = 0; children >> child;) found.emplace_back(fmt::format("/proc/{}", child));
  }
  if (listed) return found;
  for (const fs::directory_entry& process : fs::directory_iterator("/proc", none)) {
    if (number_of(process.path()) > 0) found.push_back(process.path());
  }
  return found;
}

}  // namespace

std::string prefer_consumers(pid_t daemon) {
  std::error_code none;
  for (const fs::path& process : candidates(daemon)) {
    if (!is_consumer_of(process, daemon)) continue;
    // On Linux a nice value belongs to a thread.
    for (const fs::directory_entry& thread : fs::directory_iterator(process / "task", none)) {
      const auto id = static_cast<id_t>(number_of(thread.path()));
      if (setpriority(PRIO_PROCESS, id, kConsumerNice) == 0 || errno == ESRCH) continue;
      return fmt::format(
          "LTTng's consumer keeps its priority ({}): on a machine that is busy all the time it may come too late, and "
          "events are lost; it takes root, CAP_SYS_NICE, or `USER - nice {}` in /etc/security/limits.conf",
          std::strerror(errno), kConsumerNice);
    }
  }
  return {};
}

}  // namespace tracing
