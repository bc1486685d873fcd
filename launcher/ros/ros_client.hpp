// SPDX-License-Identifier: Apache-2.0
// What a launch asks of the ROS graph. The seam between the launcher, which links no middleware, and the program
// launch-ros-client (launcher/ros/client/), which does.
//
// Names are absolute: "/left/driver" for a node, "/left/scan" for a topic or a service.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/composable_node.hpp"

namespace launch {

// Calls of services. Each waits until the service is there, then until it has answered.
struct LoadNode {
  std::string container;
  ComposableNode node;
};
struct UnloadNode {
  std::string container;
  std::uint64_t unique_id = 0;
};
struct ListNodes {
  std::string container;
};
struct ChangeState {
  std::string node;
  std::string transition;  // configure, activate, deactivate, cleanup or shutdown
};
struct GetState {
  std::string node;
};

// Conditions. Answered once they hold, at once when they do already.
struct NodePresent {
  std::string node;
};
struct TopicPresent {  // somebody publishes it
  std::string topic;
};
struct ServicePresent {
  std::string service;
};
// A message has arrived since the request was made, or a publisher keeps its last one for late subscribers.
struct MessagePublished {
  std::string topic;
};
struct StateReached {
  std::string node;
  std::string state;  // unconfigured, inactive, active or finalized
};

// Answered at every change of the node's state, until it is cancelled.
struct WatchTransitions {
  std::string node;
};

using RosRequest = std::variant<LoadNode, UnloadNode, ListNodes, ChangeState, GetState, NodePresent, TopicPresent,
                                ServicePresent, MessagePublished, StateReached, WatchTransitions>;

struct RosAnswer {
  bool ok = false;
  std::string error;         // when it is not: the container's words, or what was waited for in vain
  bool client_lost = false;  // nobody can answer: launch-ros-client can't be started, or has ended

  std::string node;                 // LoadNode: its full name
  std::uint64_t unique_id = 0;      // LoadNode: its number in the container
  std::vector<std::string> nodes;   // ListNodes: full names …
  std::vector<std::uint64_t> ids;   // … and their numbers
  std::string state;                // GetState, StateReached, WatchTransitions: the state now
  std::string previous_state = {};  // WatchTransitions: the one before
};

// What the request waits for, for messages: "the '/c/_container/load_node' service", "a publisher of '/scan'".
std::string describe(const RosRequest& request);

class RosClient {
 public:
  using Done = std::function<void(const RosAnswer&)>;

  virtual ~RosClient() = default;

  // Never blocks. `environment` tells which graph is meant (ROS_DOMAIN_ID and the like). Without an answer within
  // `timeout` the answer is an error; zero waits for ever. `done` is called in a later turn of the loop, once unless
  // the request says otherwise. Destroying the source, which `done` may do, cancels the request.
  [[nodiscard]] virtual EventLoop::SourcePtr ask(const RosRequest& request, const Environment& environment,
                                                 Duration timeout, Done done) = 0;

  // No more requests will come: frees what the client holds, without waiting.
  virtual void close() = 0;
};

}  // namespace launch
