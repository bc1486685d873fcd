// SPDX-License-Identifier: Apache-2.0
// Events that have happened and whose handlers have not been visited yet.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/visit/event_handler.hpp"

namespace launch {

// The handlers of each event are visited in a turn of the loop of their own, because handlers start and stop processes,
// which an observer of their events must not do. Events keep their order.
class InvocationQueue {
 public:
  // `visited` is called when all handlers of one event have been visited. The loop must outlive this object.
  InvocationQueue(EventLoop& loop, std::function<void(const Invocation&)> visit, std::function<void()> visited)
      : loop_(loop), visit_(std::move(visit)), visited_(std::move(visited)) {}

  // Adds all handlers of one event. Does nothing without handlers.
  void add(std::vector<Invocation> invocations);
  // Handlers of that name are not visited any more, except for the event whose handlers are being visited: one of them
  // may forget another one, which still gets this event.
  void forget(const std::string& name);
  // False also while handlers are being visited, because the system is not idle between two of them.
  bool empty() const { return events_.empty(); }

 private:
  void visit_next();

  EventLoop& loop_;
  std::function<void(const Invocation&)> visit_;
  std::function<void()> visited_;
  std::deque<std::vector<Invocation>> events_;
};

inline void InvocationQueue::add(std::vector<Invocation> invocations) {
  if (!invocations.empty()) {
    events_.push_back(std::move(invocations));
    loop_.post([this] { visit_next(); });
  }
}

inline void InvocationQueue::forget(const std::string& name) {
  for (std::vector<Invocation>& event : events_) {
    std::erase_if(event, [&](const Invocation& each) { return each.handler->name == name; });
  }
}

inline void InvocationQueue::visit_next() {
  const std::vector<Invocation> invocations = std::move(events_.front());
  events_.front().clear();
  for (const Invocation& invocation : invocations) {
    visit_(invocation);
  }
  events_.pop_front();
  visited_();
}

}  // namespace launch
