// SPDX-License-Identifier: Apache-2.0
// A cgroup for the processes of a launch, where the user has one to divide (`systemd-run --user --scope -p Delegate=yes
// launch …`). No process can leave it, whatever it does to its parent, its session and its environment.
#pragma once

#include <sys/types.h>

#include <set>
#include <string>
#include <vector>

namespace launch {

class LaunchCgroup {
 public:
  // No cgroup.
  LaunchCgroup() = default;

  // Makes one below the cgroup of this process, if that one is of version 2 and delegated (systemd's mark of it), and
  // moves the launcher there. What the launcher starts is there, too. This takes some milliseconds.
  static LaunchCgroup make(const std::string& launch_id, pid_t launcher);

  // The one that make() has made in another process.
  static LaunchCgroup find(const std::string& launch_id);

  bool exists() const { return !path_.empty(); }

  // The processes there, also in cgroups that they have made themselves.
  std::set<pid_t> members() const;
  // Kills all of them at once (Linux 5.14): even one that starts others faster than they can be found.
  void kill() const;
  // To be called when all have ended. A cgroup with processes stays.
  void remove() const;

 private:
  explicit LaunchCgroup(std::string path) : path_(std::move(path)) {}

  // The cgroup of the launcher, and the one beside it with the processes that have limits.
  std::vector<std::string> trees() const;

  std::string path_;
};

}  // namespace launch
