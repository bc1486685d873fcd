#include "launcher/core/state_handlers.hpp"

#include <utility>

#include "launcher/base/diagnostic.hpp"

namespace launch {

void StateHandlers::add(EventHandler handler, RosClient* client) {
  if (client == nullptr) {
    fail_(LaunchError("there is no ROS client to watch the states of nodes", handler.where));
    return;
  }
  watches_.push_back({std::make_shared<const EventHandler>(std::move(handler)), nullptr});
  const auto watch = std::prev(watches_.end());
  const EventHandler& watching = *watch->handler;
  watch->source =
      client->ask(WatchTransitions{std::get<OnStateTransition>(watching.event).node}, watching.scope.environment,
                  Duration(0), [this, watch](const RosAnswer& answer) { on_answer(watch, answer); });
}

void StateHandlers::on_answer(std::list<Watch>::iterator watch, const RosAnswer& answer) {
  const std::shared_ptr<const EventHandler> handler = watch->handler;
  if (!answer.ok) {
    const EventLoop::SourcePtr answered = std::move(watch->source);  // outlives its callback
    watches_.erase(watch);
    fail_(LaunchError(answer.error, handler->where));
    return;
  }
  const auto& wanted = std::get<OnStateTransition>(handler->event);
  if ((!wanted.start_state.empty() && wanted.start_state != answer.previous_state) ||
      (!wanted.goal_state.empty() && wanted.goal_state != answer.state)) {
    return;
  }
  EventLoop::SourcePtr answered;
  if (handler->once) {
    answered = std::move(watch->source);
    watches_.erase(watch);
  }
  invoke_({{handler, {{"node", wanted.node}, {"start_state", answer.previous_state}, {"goal_state", answer.state}}}});
}

bool StateHandlers::remove(const std::string& name) {
  return std::erase_if(watches_, [&](const Watch& watch) { return watch.handler->name == name; }) != 0;
}

}  // namespace launch
