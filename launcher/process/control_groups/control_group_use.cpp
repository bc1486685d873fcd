// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/control_groups/control_group_use.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "launcher/process/guardian/own_cgroup.hpp"
#include "launcher/process/guardian/process_scan.hpp"

namespace launch {
namespace {

// "max" is no number.
std::optional<std::uint64_t> number_of(const std::string& text) {
  char* end = nullptr;
  const std::uint64_t number = std::strtoull(text.c_str(), &end, 10);
  return end == text.c_str() ? std::nullopt : std::optional(number);
}

// "MAX PERIOD"
std::optional<double> quota_of(const std::string& text) {
  const std::size_t blank = text.find(' ');
  const std::optional<std::uint64_t> most = number_of(text);
  const std::optional<std::uint64_t> period =
      blank == std::string::npos ? std::nullopt : number_of(text.substr(blank + 1));
  return most && period && *period > 0 ? std::optional(static_cast<double>(*most) / static_cast<double>(*period))
                                       : std::nullopt;
}

}  // namespace

std::uint64_t read_number(const std::string& file) {
  return number_of(read_whole_file(file)).value_or(0);
}

std::uint64_t read_keyed(const std::string& file, const std::string& key) {
  for (const std::vector<std::string>& line : words_of_lines(read_whole_file(file))) {
    if (line.size() == 2 && line[0] == key) {
      return number_of(line[1]).value_or(0);
    }
  }
  return 0;
}

ControlGroupUse read_control_group(const std::string& path) {
  const auto number = [&](const char* file) { return number_of(read_whole_file(path + file)); };
  ControlGroupUse use;
  use.name = std::filesystem::path(path).filename().string();
  use.memory = number("/memory.current");
  use.memory_max = number("/memory.max");
  use.memory_high = number("/memory.high");
  use.pids = number("/pids.current");
  use.pids_max = number("/pids.max");
  use.cpu_quota = quota_of(read_whole_file(path + "/cpu.max"));
  if (use.cpu_quota) {
    use.throttled = read_keyed(path + "/cpu.stat", "throttled_usec");
  }
  use.out_of_memory = read_keyed(path + "/memory.events", "oom_kill");
  use.slowed = read_keyed(path + "/memory.events", "high");
  use.refused = read_keyed(path + "/pids.events", "max");
  return use;
}

std::vector<ControlGroupUse> read_control_groups(const std::string& path) {
  std::vector<ControlGroupUse> uses;
  for (std::filesystem::path group = path; group.has_filename() && !group.filename().string().ends_with(kLimited);
       group = group.parent_path()) {
    uses.push_back(read_control_group(group.string()));
  }
  std::reverse(uses.begin(), uses.end());
  return uses;
}

}  // namespace launch
