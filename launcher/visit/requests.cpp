// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/requests.hpp"

#include <variant>

#include "base/diagnostics/diagnostic.hpp"
#include "base/overloaded.hpp"

namespace launch {

std::size_t Requests::count() const {
  std::size_t count = 0;
  for_each_kind(*this, [&](const auto& kind) { count += kind.size(); });
  return count;
}

void check_conditions(const std::vector<EventHandler>& handlers, bool is_recorded) {
  for (const EventHandler& handler : handlers) {
    const auto* const condition = std::get_if<OnCondition>(&handler.event);
    if (!is_recorded && condition != nullptr && !is_of_process(condition->condition)) {
      throw LaunchError("nothing is recorded that could tell whether this condition holds", handler.where,
                        "add <trace session-name=\"…\"/> to the launch file, or start it with launch --trace");
    }
  }
}

void check_farewell(const Requests& requests, bool may_ask_nodes) {
  const auto refuse_node = [&](const SourceRange& where) {
    if (!may_ask_nodes) {
      throw LaunchError("components are not loaded and states not changed when the system ends", where,
                        "run a program that does it, such as ros2 lifecycle", Finding::kWrongPlace);
    }
  };
  for_each_request(requests, Overloaded{
                                 [](const RunScopePtr& scope) {
                                   throw LaunchError("a trace can't begin when the system ends", scope->origin(),
                                                     "put it outside of on_shutdown", Finding::kWrongPlace);
                                 },
                                 [&](const LoadRequest& load) { refuse_node(load.origin); },
                                 [&](const TransitionRequest& transition) { refuse_node(transition.origin); },
                                 [](const CoroutineRequest& coroutine) {
                                   throw LaunchError("a coroutine can't begin when the system ends", coroutine.where,
                                                     "use OpaqueFunction inside of OnShutdown", Finding::kWrongPlace);
                                 },
                                 [](const Dependency& dependency) {
                                   throw LaunchError("a process can't wait for others when the system ends",
                                                     dependency.where, "leave depends_on out inside of on_shutdown",
                                                     Finding::kWrongPlace);
                                 },
                                 PassOver<ProcessCommand, UnregisterRequest, TestRequest, EventHandler, TimerRequest,
                                          ProcessSpec, ShutdownRequest, NodeDescription>(),
                             });
}

}  // namespace launch
