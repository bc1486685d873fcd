// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/farewell_check.hpp"

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

void check_farewell(const Requests& requests, bool may_ask_nodes) {
  if (!requests.scopes.empty()) {
    throw LaunchError("a trace can't begin when the system ends", requests.scopes.front()->origin(),
                      "put it outside of on_shutdown", Finding::kWrongPlace);
  }
  if (!may_ask_nodes && (!requests.loads.empty() || !requests.transitions.empty())) {
    throw LaunchError("components are not loaded and states not changed when the system ends",
                      requests.loads.empty() ? requests.transitions.front().origin : requests.loads.front().origin,
                      "run a program that does it, such as ros2 lifecycle", Finding::kWrongPlace);
  }
  if (!requests.coroutines.empty()) {
    throw LaunchError("a coroutine can't begin when the system ends", requests.coroutines.front().where,
                      "use OpaqueFunction inside of OnShutdown", Finding::kWrongPlace);
  }
  if (!requests.dependencies.empty()) {
    throw LaunchError("a process can't wait for others when the system ends", requests.dependencies.front().where,
                      "leave depends_on out inside of on_shutdown", Finding::kWrongPlace);
  }
}

}  // namespace launch
