// SPDX-License-Identifier: Apache-2.0
// Attributes of <trace> and <channel> that hold rules of events, such as `ros2:* except ros2:rcl_init if vpid > 1`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/language/setting.hpp"

namespace launch {

enum class Tracepoints { kUserspace /* PROVIDER:NAME */, kKernel /* NAME */ };

// The rules of an attribute. A substitution may give a rule with blanks, or several names. Throws LaunchError at the
// place of the attribute when a rule is wrong.
std::vector<std::string> perform_event_rules(const Fields& fields, const std::string& attribute, Scope& scope,
                                             Tracepoints of);

// For a row: reads the rules of an attribute into the list at `place`.
template <typename Target>
auto event_rules(const char* attribute, Tracepoints of, std::function<SettingPlace(Target&)> place) {
  return [attribute, of, place](const Fields& fields, Scope& scope, Target& target) {
    *std::get<std::vector<std::string>*>(place(target)) = perform_event_rules(fields, attribute, scope, of);
  };
}

}  // namespace launch
