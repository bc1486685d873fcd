// SPDX-License-Identifier: Apache-2.0
// Event handlers and coroutines of a launch: how handlers are registered, and visited when their event has happened.
#include <fmt/format.h>

#include <utility>

#include "launcher/run/launch_service.hpp"

namespace launch {

// In a later turn: handlers start and stop processes, which observers of their events should not.
void LaunchService::invoke(std::vector<Invocation> invocations) {
  if (!invocations.empty()) {
    events_.push_back(std::move(invocations));
    loop_.post([this] { run_invocations(); });
  }
}

// All handlers of one event: one of them may unregister another, which still hears of this event but of no later one.
void LaunchService::run_invocations() {
  const std::vector<Invocation> invocations = std::move(events_.front());
  for (const Invocation& invocation : invocations) {
    visit(invocation.scope(), invocation.handler->actions);
  }
  events_.pop_front();  // not before: the system is not idle between two of them
  check_finished();
}

void LaunchService::on_step() {
  Requests requests = context_.take_requests();
  if (requests.empty()) {
    check_finished();
  } else {
    carry_out(std::move(requests));
  }
}

void LaunchService::register_handler(EventHandler handler) {
  if (std::holds_alternative<OnceReady>(handler.event)) {
    wait_for(std::move(handler));
  } else if (std::holds_alternative<OnStateTransition>(handler.event)) {
    state_handlers_.add(std::move(handler), context_.ros_client());
  } else {
    handlers_.add(std::move(handler));
  }
}

void LaunchService::unregister_handlers(const UnregisterRequest& request) {
  const bool registered = handlers_.remove(request.name) | state_handlers_.remove(request.name);
  // Events that wait for their turn.
  for (std::vector<Invocation>& event : events_) {
    std::erase_if(event, [&](const Invocation& each) { return each.handler->name == request.name; });
  }
  if (!registered) {
    context_.message(
        LogLevel::kWarning, "launch",
        fmt::format("no event handler is registered that is named '{}' ({})", request.name, to_string(request.where)));
  }
}

void LaunchService::wait_for(EventHandler handler) {
  const auto place = waits_.insert(waits_.end(), std::make_shared<const EventHandler>(std::move(handler)));
  std::get<OnceReady>((*place)->event)
      .condition->watch(loop_, [this, place](const std::optional<std::string>& failure) {
        const std::shared_ptr<const EventHandler> ready = *place;
        waits_.erase(place);
        if (failure) {
          fail(LaunchError(*failure, ready->where));
        } else {
          invoke({{ready, {}}});
        }
      });
}

}  // namespace launch
