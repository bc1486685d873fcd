// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/control_groups/control_group.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launch {

std::vector<std::string> describe(const ControlGroupLimits& limits) {
  std::vector<std::string> lines;
  const auto add = [&](const auto& limit, const char* text) {
    if (limit) {
      lines.push_back(fmt::format(fmt::runtime(text), *limit));
    }
  };
  add(limits.memory_max, "memory_max {} bytes");
  add(limits.memory_high, "memory_high {} bytes");
  if (limits.cpu_quota) {
    lines.push_back(fmt::format("cpu_quota {:g}%", *limits.cpu_quota * 100));
  }
  add(limits.cpu_weight, "cpu_weight {}");
  add(limits.io_weight, "io_weight {}");
  add(limits.pids_max, "pids_max {}");
  return lines;
}

std::vector<ControlGroupSetting> settings_of(const ControlGroupLimits& limits) {
  std::vector<ControlGroupSetting> settings;
  const auto add = [&](const auto& limit, const char* attribute, const char* controller, const char* file) {
    if (limit) {
      settings.push_back({attribute, controller, file, std::to_string(*limit)});
    }
  };
  add(limits.memory_high, "memory_high", "memory", "memory.high");
  add(limits.memory_max, "memory_max", "memory", "memory.max");
  if (limits.cpu_quota) {
    constexpr double kPeriod = 100000;  // microseconds
    settings.push_back(
        {"cpu_quota", "cpu", "cpu.max", fmt::format("{:.0f} {:.0f}", std::ceil(*limits.cpu_quota * kPeriod), kPeriod)});
  }
  add(limits.cpu_weight, "cpu_weight", "cpu", "cpu.weight");
  add(limits.io_weight, "io_weight", "io", "io.weight");
  add(limits.pids_max, "pids_max", "pids", "pids.max");
  return settings;
}

}  // namespace launch
