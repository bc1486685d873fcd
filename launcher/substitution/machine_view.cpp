// SPDX-License-Identifier: Apache-2.0
#include "launcher/substitution/machine_view.hpp"

#include <fmt/format.h>

namespace launch {

Environment carry_changes(const Environment& before, const Environment& now, const Environment& onto) {
  Environment result = onto;
  for (const auto& [name, value] : now) {
    const auto old = before.find(name);
    if (old == before.end()) {
      result.insert_or_assign(name, value);
    } else if (old->second != value) {
      const auto there = onto.find(name);
      const bool extends = there != onto.end() && !old->second.empty();
      if (extends && value.starts_with(old->second)) {
        result.insert_or_assign(name, there->second + value.substr(old->second.size()));
      } else if (extends && value.ends_with(old->second)) {
        result.insert_or_assign(name, value.substr(0, value.size() - old->second.size()) + there->second);
      } else {
        result.insert_or_assign(name, value);
      }
    }
  }
  for (const auto& [name, value] : before) {
    if (!now.contains(name)) {
      result.erase(name);
    }
  }
  for (const std::string& name : now.decided()) {
    result.decide(name);
    const auto value = now.find(name);
    const auto old = before.find(name);
    if (value == now.end()) {
      result.erase(name);
    } else if (old != before.end() && old->second == value->second) {
      result.insert_or_assign(name, value->second);
    }
  }
  return result;
}

Environment home_environment(const Scope& scope) {
  return scope.machine == nullptr
             ? scope.environment
             : carry_changes(scope.machine->environment(), scope.environment, scope.home->environment);
}

std::shared_ptr<PackageIndex> home_packages(const Scope& scope) {
  return scope.machine == nullptr ? scope.packages : scope.home->packages;
}

std::string unknown_there(const std::string& what, const MachineView& machine) {
  return fmt::format("<{} on {}>", what, machine.name());
}

}  // namespace launch
