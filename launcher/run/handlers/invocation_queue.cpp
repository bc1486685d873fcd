// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/handlers/invocation_queue.hpp"

namespace launch {

void InvocationQueue::add(std::vector<Invocation> invocations) {
  if (!invocations.empty()) {
    events_.push_back(std::move(invocations));
    loop_.post([this] { visit_next(); });
  }
}

void InvocationQueue::forget(const std::string& name) {
  for (std::vector<Invocation>& event : events_) {
    std::erase_if(event, [&](const Invocation& each) { return each.handler->name == name; });
  }
}

void InvocationQueue::visit_next() {
  const std::vector<Invocation> invocations = std::move(events_.front());
  events_.front().clear();
  for (const Invocation& invocation : invocations) {
    visit_(invocation);
  }
  events_.pop_front();
  visited_();
}

}  // namespace launch
