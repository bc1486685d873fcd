// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/handlers.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace launch {

Handlers::Handlers(EventLoop& loop, std::function<void(const Invocation&)> visit, std::function<void()> visited,
                   const std::function<void(const LaunchError&)>& fail)
    : queue_(loop, std::move(visit), std::move(visited)),
      states_([this](std::vector<Invocation> invocations) { queue_.add(std::move(invocations)); }, fail),
      conditions_(
          loop, [this](std::vector<Invocation> invocations) { queue_.add(std::move(invocations)); }, fail),
      live_(
          loop, [this](std::vector<Invocation> invocations) { queue_.add(std::move(invocations)); }, fail) {}

void Handlers::add(EventHandler handler, RosClient* client) {
  if (std::holds_alternative<OnceReady>(handler.event)) {
    conditions_.add(std::move(handler));
  } else if (std::holds_alternative<OnCondition>(handler.event)) {
    live_.add(std::move(handler));
  } else if (std::holds_alternative<OnStateTransition>(handler.event)) {
    states_.add(std::move(handler), client);
  } else {
    events_.add(std::move(handler));
  }
}

void Handlers::unregister(const std::vector<UnregisterRequest>& requests,
                          const std::function<void(const std::string& text)>& warn) {
  for (const UnregisterRequest& request : requests) {
    if (!remove(request.name)) {
      warn(fmt::format("no event handler is registered that is named '{}' ({})", request.name,
                       to_string(request.where)));
    }
  }
}

void Handlers::clear() {
  events_.clear();
  states_.clear();
  conditions_.clear();
  live_.clear();
}

bool Handlers::remove(const std::string& name) {
  queue_.forget(name);
  const bool of_events = events_.remove(name);
  const bool of_states = states_.remove(name);
  const bool of_conditions = live_.remove(name);
  return of_events || of_states || of_conditions;
}

std::vector<Invocation> Handlers::shutdown(const std::string& reason) {
  conditions_.clear();
  states_.clear();
  live_.shutdown();
  return events_.on_shutdown(reason);
}

}  // namespace launch
