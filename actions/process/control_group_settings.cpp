// SPDX-License-Identifier: Apache-2.0
#include "actions/process/control_group_settings.hpp"

#include <fmt/format.h>

#include <string>

#include "actions/process/resource_settings.hpp"

namespace launch {

namespace {

using Type = AttributeType;
using Limits = ControlGroupLimits;
using Bytes = std::optional<std::uint64_t>;

template <Bytes Limits::*Member>
Setting<Limits> memory_setting(const char* name, const char* help) {
  return {.attribute = {name, Type::kText, false, "none", help, true},
          .perform =
              [name](const Fields& fields, Scope& scope, Limits& limits) {
                limits.*Member = parse_bytes(fields.text(name).perform(scope), fields.where(name));
              },
          .checks_literal = true};
}

template <Bytes Limits::*Member>
Setting<Limits> number_setting(const char* name, const char* fallback, std::uint64_t most, const char* help) {
  return {.attribute = {name, Type::kInteger, false, fallback, help, true},
          .perform = [name, most](const Fields& fields, Scope& scope, Limits& limits) {
            const double value = fields.number(name)->perform(scope);
            if (value < 1 || value > static_cast<double>(most)) {
              throw LaunchError(fmt::format("{} is a number from 1 to {}, got {}", name, most, value),
                                fields.where(name));
            }
            limits.*Member = static_cast<std::uint64_t>(value);
          }};
}

void perform_quota(const Fields& fields, Scope& scope, Limits& limits) {
  limits.cpu_quota = parse_share(fields.text("cpu_quota").perform(scope), fields.where("cpu_quota"));
}

}  // namespace

const std::vector<Setting<ControlGroupLimits>>& control_group_settings() {
  constexpr std::uint64_t kMostWeight = 10000;
  constexpr std::uint64_t kMostProcesses = 4194304;  // PID_MAX_LIMIT of the kernel
  static const std::vector<Setting<Limits>> settings = {
      memory_setting<&Limits::memory_max>(
          "memory_max",
          "memory of all its processes together, in bytes, or with K, M or G; the kernel ends one of them "
          "that wants more"),
      memory_setting<&Limits::memory_high>(
          "memory_high", "as memory_max, but the kernel slows processes that want more, and takes memory back"),
      {.attribute = {"cpu_quota", Type::kText, false, "none",
                     "time of processors for all its processes together, in percents of one processor, such as 150%",
                     true},
       .perform = perform_quota,
       .checks_literal = true},
      number_setting<&Limits::cpu_weight>("cpu_weight", "100", kMostWeight,
                                          "share of the processors beside others that want them, from 1 to 10000"),
      number_setting<&Limits::io_weight>("io_weight", "100", kMostWeight,
                                         "share of the disks beside others that want them, from 1 to 10000"),
      number_setting<&Limits::pids_max>("pids_max", "none", kMostProcesses,
                                        "how many processes and threads there may be"),
  };
  return settings;
}

}  // namespace launch
