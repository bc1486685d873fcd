// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/launch_processes.hpp"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <system_error>

#include "base/processes/process_stat.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

std::string launch_processes_of(const std::string& counters) {
  return counters + "/launch-processes";
}

std::map<pid_t, pid_t> parents_of_all() {
  std::map<pid_t, pid_t> parents;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc", none)) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), pid).ptr == name.data() + name.size() && pid > 0) {
      parents[pid] = launch::read_process_stat(pid).parent;
    }
  }
  return parents;
}

}  // namespace

void note_launch_processes(const std::string& counters, const std::vector<pid_t>& processes) {
  if (counters.empty() || processes.empty()) {
    return;
  }
  std::string lines;
  for (const pid_t process : processes) {
    lines += std::to_string(process) + '\n';
  }
  std::ofstream(launch_processes_of(counters), std::ios::app) << lines;
}

std::vector<pid_t> related_processes() {
  const std::map<pid_t, pid_t> parents = parents_of_all();
  const auto parent_of = [&parents](pid_t pid) {
    const auto found = parents.find(pid);
    return found == parents.end() ? 0 : found->second;
  };
  std::set<pid_t> related;
  for (pid_t pid = ::getpid(); pid > 0 && related.insert(pid).second;) {
    pid = parent_of(pid);
  }
  for (const auto& [process, parent] : parents) {
    std::vector<pid_t> way;
    for (pid_t pid = process; pid > 0 && pid != ::getpid() && way.size() < parents.size(); pid = parent_of(pid)) {
      way.push_back(pid);
    }
    if (!way.empty() && parent_of(way.back()) == ::getpid()) {
      related.insert(way.begin(), way.end());
    }
  }
  return {related.begin(), related.end()};
}

std::vector<std::int64_t> read_launch_processes(const std::string& counters, const std::vector<EventCounts>& counts) {
  if (counters.empty()) {
    return {};
  }
  std::set<std::int64_t> processes;
  std::ifstream file(launch_processes_of(counters));
  for (std::int64_t pid = 0; file >> pid;) {
    processes.insert(pid);
  }
  if (processes.empty()) {
    return {};
  }
  for (const EventCounts& process : counts) {
    processes.insert(process.pid);
  }
  return {processes.begin(), processes.end()};
}

}  // namespace tracing
