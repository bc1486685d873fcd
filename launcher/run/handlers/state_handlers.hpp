// SPDX-License-Identifier: Apache-2.0
// The handlers of nodes with a managed life cycle. Each node is watched once, so that its handlers get a change
// together, in the order of their registration.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "launcher/ros/ros_client.hpp"
#include "launcher/run/handlers/event_handlers.hpp"

namespace launch {

class StateHandlers {
 public:
  // `invoke` gets the handlers to visit, `fail` an error that prevents the watch of a node.
  StateHandlers(std::function<void(std::vector<Invocation>)> invoke, std::function<void(const LaunchError&)> fail)
      : invoke_(std::move(invoke)), fail_(std::move(fail)) {}

  // Watches the node of an OnStateTransition, in the graph of the handler's scope, until it is removed; with `once`
  // until the first event. A null client is an error.
  void add(EventHandler handler, RosClient* client);
  // Forgets the handlers of that name; false when there is none.
  bool remove(const std::string& name);
  void clear() { watches_.clear(); }

 private:
  // The watch of one node in one graph, for at least one handler.
  struct Watch {
    std::string node;
    Environment environment;
    std::vector<std::shared_ptr<const EventHandler>> handlers;
    EventLoop::SourcePtr source;
  };
  using Place = std::list<Watch>::iterator;

  void on_answer(Place watch, const RosAnswer& answer);

  std::function<void(std::vector<Invocation>)> invoke_;
  std::function<void(const LaunchError&)> fail_;
  std::list<Watch> watches_;
};

}  // namespace launch
