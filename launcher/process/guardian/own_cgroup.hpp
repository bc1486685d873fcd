// SPDX-License-Identifier: Apache-2.0
// The cgroup of version 2 in which this process is. Also a part of launch-guardian, which is linked statically.
#pragma once

#include <string>
#include <vector>

namespace launch {

// A launch has the cgroup "launch-ID" where it may divide its own one, and beside it two with these ends: one for its
// processes with limits, one for what is outside of the launch.
inline constexpr const char* kLimited = "-limits";
inline constexpr const char* kOutside = "-outside";

// Where it is in the file system. Both are "" when there is none, or when it is not mounted.
struct OwnCgroup {
  std::string path;   // "/sys/fs/cgroup/user.slice/…"
  std::string mount;  // "/sys/fs/cgroup"
};

OwnCgroup own_cgroup();
// From the texts of /proc/PID/cgroup and /proc/PID/mountinfo.
OwnCgroup own_cgroup(const std::string& cgroup, const std::string& mountinfo);

// Whether this directory is one that systemd has given to the user to divide (Delegate=yes).
bool is_delegated(const std::string& path);

// The lines of a text, each cut into words at blanks.
std::vector<std::vector<std::string>> words_of_lines(const std::string& text);

}  // namespace launch
