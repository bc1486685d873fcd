// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/state_handlers.hpp"

#include <algorithm>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

bool concerns(const EventHandler& handler, const RosAnswer& change) {
  const auto& wanted = std::get<OnStateTransition>(handler.event);
  return (wanted.start_state.empty() || wanted.start_state == change.previous_state) &&
         (wanted.goal_state.empty() || wanted.goal_state == change.state);
}

}  // namespace

void StateHandlers::add(EventHandler handler, RosClient* client) {
  if (client == nullptr) {
    fail_(LaunchError("there is no ROS client to watch the states of nodes", handler.where));
    return;
  }
  const std::string& node = std::get<OnStateTransition>(handler.event).node;
  const Environment& environment = handler.scope.environment;
  auto watch = std::find_if(watches_.begin(), watches_.end(),
                            [&](const Watch& each) { return each.node == node && each.environment == environment; });
  if (watch == watches_.end()) {
    watch = watches_.insert(watches_.end(), {node, environment, {}, nullptr});
    watch->source = client->ask(WatchTransitions{node}, environment, Duration(0),
                                [this, watch](const RosAnswer& answer) { on_answer(watch, answer); });
  }
  watch->handlers.push_back(std::make_shared<const EventHandler>(std::move(handler)));
}

void StateHandlers::on_answer(Place watch, const RosAnswer& answer) {
  if (!answer.ok) {
    const Watch failed = std::move(*watch);  // its source must outlive the callback
    watches_.erase(watch);
    fail_(LaunchError(answer.error, failed.handlers.front()->where));
    return;
  }
  std::vector<Invocation> invocations;
  for (const auto& handler : watch->handlers) {
    if (concerns(*handler, answer)) {
      invocations.push_back(
          {handler, {{"node", watch->node}, {"start_state", answer.previous_state}, {"goal_state", answer.state}}});
    }
  }
  std::erase_if(watch->handlers, [&](const auto& handler) { return handler->once && concerns(*handler, answer); });
  EventLoop::SourcePtr answered;
  if (watch->handlers.empty()) {
    answered = std::move(watch->source);
    watches_.erase(watch);
  }
  invoke_(std::move(invocations));
}

bool StateHandlers::remove(const std::string& name) {
  std::size_t removed = 0;
  for (Watch& watch : watches_) {
    removed += std::erase_if(watch.handlers, [&](const auto& handler) { return handler->name == name; });
  }
  watches_.remove_if([](const Watch& watch) { return watch.handlers.empty(); });
  return removed != 0;
}

}  // namespace launch
