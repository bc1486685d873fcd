// SPDX-License-Identifier: Apache-2.0
// What stands on a machine in the way of real time, of tracing, of limits and of nodes. Everything is read below a
// directory, so that tests can make machines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launch {

struct MachineCheck {
  std::string area;  // "real time", "tracing", "limits", "nodes"
  std::string name;  // "governor"
  bool ok = false;
  std::string found;   // "CPUs 0-3: powersave"
  std::string advice;  // what to do; empty if it is ok
};

class Machine {
 public:
  explicit Machine(std::filesystem::path root) : root_(std::move(root)) {}

  std::filesystem::path path(const std::string& below) const { return root_ / below; }
  bool has(const std::string& below) const;
  // The first line of a file, without its end; "" if it can't be read.
  std::string line(const std::string& file) const;
  std::string text(const std::string& file) const;
  // "0,2-3" as numbers; none if the file can't be read.
  std::vector<int> cpus(const std::string& file) const;
  // The entries of a directory that begin so, sorted.
  std::vector<std::string> entries(const std::string& directory, const std::string& begin = {}) const;
  // Of this process: the soft limit of a row of /proc/self/limits; nothing: unlimited.
  std::optional<std::uint64_t> soft_limit(const std::string& row) const;
  // Whether this process has a capability, by its number.
  bool has_capability(unsigned number) const;

 private:
  std::filesystem::path root_;
};

// `cpus` are those that are chosen for real time; if there are none, the isolated ones.
std::vector<MachineCheck> check_real_time(const Machine& machine, std::vector<int> cpus);
std::vector<MachineCheck> check_tracing(const Machine& machine);
// Whether the nodes that run can hear each other. Of processes of others only root sees the settings.
std::vector<MachineCheck> check_nodes(const Machine& machine);
std::vector<MachineCheck> check_limits(const Machine& machine, bool is_root);

}  // namespace launch
