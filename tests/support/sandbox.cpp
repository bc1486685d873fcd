// SPDX-License-Identifier: Apache-2.0
#include "tests/support/sandbox.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <set>
#include <system_error>

#include "base/environment/domain_lease.hpp"
#include "base/environment/network_device.hpp"
#include "tests/support/emulated.hpp"

namespace test_support {
namespace {

namespace fs = std::filesystem;

void check(int result, const std::string& what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
}

struct ProcessInfo {
  std::string name;
  char state = '?';
  pid_t parent = 0;
};

// From /proc/PID/stat, proc(5): "pid (name) state parent …".
std::optional<ProcessInfo> read_process(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t open = line.find('(');
  const std::size_t close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 4 >= line.size()) {
    return std::nullopt;
  }
  return ProcessInfo{line.substr(open + 1, close - open - 1), line[close + 2],
                     static_cast<pid_t>(std::atoi(line.c_str() + close + 4))};
}

// All descendants of this process, including zombies.
std::map<pid_t, ProcessInfo> descendants() {
  std::map<pid_t, ProcessInfo> all;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const pid_t pid = static_cast<pid_t>(std::atoi(entry.path().filename().c_str()));
    if (pid <= 0) {
      continue;
    }
    if (auto info = read_process(pid)) {
      all.emplace(pid, std::move(*info));
    }
  }
  std::map<pid_t, ProcessInfo> below;
  for (const auto& [pid, info] : all) {
    for (auto ancestor = all.find(info.parent); ancestor != all.end(); ancestor = all.find(ancestor->second.parent)) {
      if (ancestor->first != getpid()) {
        continue;
      }
      below.emplace(pid, info);
      break;
    }
  }
  return below;
}

// lttng-sessiond, its lttng-runas helpers, lttng-consumerd and lttng-relayd. They are meant to outlive the process that
// started them.
bool is_lttng_daemon(const ProcessInfo& process) {
  return process.name.starts_with("lttng-");
}

fs::path make_directory() {
  const char* parent = std::getenv("TMPDIR");
  std::string name = (fs::path(parent != nullptr && *parent != '\0' ? parent : "/tmp") / "sandbox-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    check(-1, "create " + name);
  }
  return name;
}

}  // namespace

Sandbox::Sandbox() : directory_(make_directory()), previous_directory_(fs::current_path()) {
  // QEMU's emulation of another processor does not know it.
  check(prctl(PR_SET_CHILD_SUBREAPER, 1) == 0 || errno == EINVAL ? 0 : -1, "become the reaper of orphans");
  int domain = 1;
  if (geteuid() == 0) {
    enter_namespaces();
  } else {
    domain_ = std::make_shared<launch::DomainLease>();
    domain = domain_->id();
    not_isolated_ =
        "not root: the network and /dev/shm are shared with the machine, LTTNG_HOME and ROS_DOMAIN_ID differ";
  }

  for (char** entry = environ; *entry != nullptr;) {
    const std::string name(*entry, std::strcspn(*entry, "="));
    if (name.starts_with("ROS_") || name == "AMENT_PREFIX_PATH") {
      set_environment(name, std::nullopt);
      entry = environ;  // the array has moved
    } else {
      ++entry;
    }
  }
  const std::map<std::string, fs::path> folders = {
      {"HOME", "home"},
      {"LTTNG_HOME", "lttng"},
      {"ROS_HOME", "ros"},
      {"ROS_LOG_DIR", "log"},
      {"ROS_TRACE_DIR", "traces"},
      {"TMPDIR", "tmp"},
      {"XDG_RUNTIME_DIR", "runtime"},
  };
  for (const auto& [variable, folder] : folders) {
    fs::create_directories(directory_ / folder);
    set_environment(variable, (directory_ / folder).string());
  }
  fs::permissions(directory_ / "runtime", fs::perms::owner_all);  // as the specification of XDG_RUNTIME_DIR asks
  set_environment("ROS_DOMAIN_ID", std::to_string(domain));
  if (const char* const prefixes = std::getenv("TEST_AMENT_PREFIX_PATH")) {
    set_environment("AMENT_PREFIX_PATH", prefixes);
  }
}

Sandbox::~Sandbox() {
  for (const std::string& name : end_processes()) {
    ADD_FAILURE() << "the test left a process behind: " << name;
  }
  for (const auto& [name, value] : std::map(previous_environment_)) {
    set_environment(name, value);
  }
  leave_namespaces();
  std::error_code ignored;
  fs::current_path(previous_directory_, ignored);
  if (std::getenv("KEEP_TEST_DIRS") != nullptr) {
    std::cout << "kept " << directory_.string() << std::endl;
  } else {
    fs::remove_all(directory_, ignored);
  }
}

std::vector<std::string> Sandbox::end_processes() {
  std::vector<std::string> unexpected;
  std::set<pid_t> seen;
  while (true) {
    const auto left = descendants();
    for (const auto& [pid, process] : left) {
      if (seen.insert(pid).second && process.state != 'Z' && !is_lttng_daemon(process)) {
        unexpected.push_back(process.name + " " + std::to_string(pid));
      }
      kill(pid, SIGKILL);
    }
    // One at a time: the children of a reaped process become ours, and the next round finds them.
    if (waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) {
      return unexpected;
    }
  }
}

void Sandbox::wait_until_daemons_are_left() {
  const auto stays = [](const auto& entry) { return entry.second.state == 'Z' || is_lttng_daemon(entry.second); };
  for (auto left = descendants(); !std::all_of(left.begin(), left.end(), stays); left = descendants()) {
    waitpid(-1, nullptr, 0);
  }
}

void Sandbox::enter_namespaces() {
  mount_namespace_ = open("/proc/self/ns/mnt", O_RDONLY | O_CLOEXEC);
  network_namespace_ = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
  check(unshare(CLONE_NEWNS | CLONE_NEWNET), "unshare mount and network namespaces");
  check(mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr), "make mounts private");
  for (const char* folder : {"/run", "/dev/shm"}) {
    check(mount("tmpfs", folder, "tmpfs", MS_NOSUID | MS_NODEV, "mode=1777"), std::string("mount tmpfs on ") + folder);
  }
  // The sockets of launches that run elsewhere, which `launch ps` would find.
  const std::string launches = "/tmp/launch-" + std::to_string(geteuid());
  check(mkdir(launches.c_str(), S_IRWXU) == 0 || errno == EEXIST ? 0 : -1, "make " + launches);
  check(mount("tmpfs", launches.c_str(), "tmpfs", MS_NOSUID | MS_NODEV, "mode=0700"), "mount tmpfs on " + launches);
  errno = launch::bring_up_loopback();
  check(errno == 0 ? 0 : -1, "bring up lo");
}

void Sandbox::leave_namespaces() {
  // Libraries keep threads that they started during the test. These threads share our root and working directory, and a
  // thread that shares these may not change its mount namespace (setns(2)).
  if (mount_namespace_ >= 0) {
    check(unshare(CLONE_FS), "unshare the working directory");
  }
  for (int* fd : {&mount_namespace_, &network_namespace_}) {
    if (*fd < 0) {
      continue;
    }
    // QEMU has threads of its own, too, and can't return; the process ends after its test.
    if (setns(*fd, 0) != 0 && vfork_shares_memory()) {
      ADD_FAILURE() << "cannot return to the first namespace: " << std::strerror(errno);
    }
    close(*fd);
    *fd = -1;
  }
}

void Sandbox::set_environment(const std::string& name, const std::optional<std::string>& value) {
  const char* previous = std::getenv(name.c_str());
  previous_environment_.try_emplace(name, previous != nullptr ? std::optional<std::string>(previous) : std::nullopt);
  if (value) {
    setenv(name.c_str(), value->c_str(), 1);
  } else {
    unsetenv(name.c_str());
  }
}

}  // namespace test_support
