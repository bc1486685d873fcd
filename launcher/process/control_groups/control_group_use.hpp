// SPDX-License-Identifier: Apache-2.0
// What the processes of a cgroup use, against its limits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace launch {

struct ControlGroupUse {
  std::string name;  // of the cgroup: "talker-1"
  std::optional<std::uint64_t> memory;
  std::optional<std::uint64_t> memory_max;  // nothing: there is no limit
  std::optional<std::uint64_t> memory_high;
  std::optional<std::uint64_t> pids;
  std::optional<std::uint64_t> pids_max;
  std::optional<double> cpu_quota;         // processors
  std::optional<std::uint64_t> throttled;  // microseconds in which the quota was used up
  std::uint64_t out_of_memory = 0;         // processes of it that the kernel has ended
  std::uint64_t slowed = 0;                // how often memory_high was exceeded
  std::uint64_t refused = 0;               // how often pids_max has prevented a process or thread
};

// Reads the files of a cgroup; what can't be read is left out.
ControlGroupUse read_control_group(const std::string& path);

// Those that hold for a process in the cgroup `path`, the outermost first: from the first one below the tree of the
// launch on.
std::vector<ControlGroupUse> read_control_groups(const std::string& path);

// The number in a file; 0 if there is none.
std::uint64_t read_number(const std::string& file);
// The value behind `key` in a file of lines "KEY VALUE"; 0 if there is none.
std::uint64_t read_keyed(const std::string& file, const std::string& key);

}  // namespace launch
