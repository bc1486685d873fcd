// SPDX-License-Identifier: Apache-2.0
// Limits that the kernel holds for a process with all its descendants, or for the processes of a <group> together, by a
// cgroup of version 2. Plain data; ControlGroupTree applies it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

struct ControlGroupLimits {
  std::optional<std::uint64_t> memory_max;   // bytes: beyond it, the kernel ends a process of the group
  std::optional<std::uint64_t> memory_high;  // bytes: beyond it, the kernel slows the processes and takes memory back
  std::optional<double> cpu_quota;           // processors
  std::optional<std::uint64_t> cpu_weight;   // 1 … 10000, 100 is that of others
  std::optional<std::uint64_t> io_weight;    // 1 … 10000, 100 is that of others
  std::optional<std::uint64_t> pids_max;     // processes and threads

  bool any() const { return memory_max || memory_high || cpu_quota || cpu_weight || io_weight || pids_max; }
};

// Of a <group> of a launch file. Each visit of it makes one.
struct ControlGroup {
  ControlGroupLimits limits;
  SourceRange where;
};

// "at most 1048576 bytes of memory", "150 % of a processor": for --dry-run.
std::vector<std::string> describe(const ControlGroupLimits& limits);

// A file of a cgroup, and what is written there.
struct ControlGroupSetting {
  std::string attribute;   // "memory_max"
  std::string controller;  // "memory"
  std::string file;        // "memory.max"
  std::string value;
};
std::vector<ControlGroupSetting> settings_of(const ControlGroupLimits& limits);

}  // namespace launch
