// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/doctor/machine.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

#include "launcher/process/resource_limits.hpp"

namespace launch {

namespace fs = std::filesystem;

bool Machine::has(const std::string& below) const {
  std::error_code unknown;
  return fs::exists(path(below), unknown);
}

std::string Machine::text(const std::string& file) const {
  std::ifstream in(path(file));
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

std::string Machine::line(const std::string& file) const {
  std::ifstream in(path(file));
  std::string line;
  std::getline(in, line);
  return line;
}

std::vector<int> Machine::cpus(const std::string& file) const {
  return parse_cpu_list(line(file)).value_or(std::vector<int>());
}

std::vector<std::string> Machine::entries(const std::string& directory, const std::string& begin) const {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(path(directory), none)) {
    if (const std::string name = entry.path().filename().string(); name.starts_with(begin)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

// "Max realtime priority     0                    0                    "
std::optional<std::uint64_t> Machine::soft_limit(const std::string& row) const {
  std::istringstream lines(text("proc/self/limits"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(row)) {
      const std::string values = line.substr(row.size());
      char* end = nullptr;
      const std::uint64_t value = std::strtoull(values.c_str(), &end, 10);
      return end == values.c_str() ? std::nullopt : std::optional(value);  // "unlimited"
    }
  }
  return 0;
}

bool Machine::has_capability(unsigned number) const {
  std::istringstream lines(text("proc/self/status"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("CapEff:")) {
      return ((std::strtoull(line.c_str() + 7, nullptr, 16) >> number) & 1U) != 0;
    }
  }
  return false;
}

}  // namespace launch
