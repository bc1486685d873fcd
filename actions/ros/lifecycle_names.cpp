// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/lifecycle_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

void require_transition(const std::string& name, const SourceRange& where) {
  static const std::vector<std::string> transitions = {"configure", "activate", "deactivate", "cleanup", "shutdown"};
  if (std::find(transitions.begin(), transitions.end(), name) == transitions.end()) {
    throw LaunchError(
        fmt::format("there is no transition '{}', expected configure, activate, deactivate, cleanup or shutdown", name),
        where, did_you_mean(name, transitions));
  }
}

}  // namespace launch
