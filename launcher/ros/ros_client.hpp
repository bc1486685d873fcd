// SPDX-License-Identifier: Apache-2.0
// The requests of a launch to the ROS graph. This is the seam between the launcher, which links no middleware, and the
// program launch-ros-client (programs/ros_client/), which does.
//
// Names are absolute: "/left/driver" for a node, "/left/scan" for a topic or a service.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "launcher/language/message_watch.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/substitution/parameter.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/composable_node.hpp"

namespace launch {

// Calls of services. Each waits until the service exists, then until it has answered.
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

// All of them or none.
struct SetParameters {
  std::string node;
  std::vector<NamedParameter> parameters;
};

// Conditions. Each is answered when it holds; at once if it holds already.
struct NodePresent {
  std::string node;
};
struct TopicPresent {  // a publisher exists
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

struct ParameterReached {
  std::string node;
  NamedParameter parameter;  // a number is equal to a number of the other type
};

// Answered at every change of the node's state, until it is cancelled.
struct WatchTransitions {
  std::string node;
};
// Answered whenever messages have come, until it is cancelled.
struct WatchMessages {
  std::string topic;
  std::string type;       // "std_msgs/msg/String"
  std::string condition;  // on their fields (launcher/message_types/message_condition.hpp); empty: none
};

// For the health of processes. Each is answered again and again, until it is cancelled: the traffic of a topic once in
// `every`. A service or a state is looked at once in `every`, and answered when the answer (RosAnswer::found) is
// another one, and twice in `every` as long as it is not good.
struct MeterTopic {
  std::string topic;
  Duration every{0};
};
struct AskService {
  std::string service;
  Duration every{0};
};
struct AskState {
  std::string node;
  Duration every{0};
};

using RosRequest = std::variant<LoadNode, UnloadNode, ListNodes, ChangeState, GetState, SetParameters, NodePresent,
                                TopicPresent, ServicePresent, MessagePublished, StateReached, ParameterReached,
                                WatchTransitions, WatchMessages, MeterTopic, AskService, AskState>;

// Of a topic, since the answer before.
struct TopicTraffic {
  std::uint64_t messages = 0;
  std::uint64_t publishers = 0;  // now
  Duration measured{0};          // the time of it in which the client looked
};

// What a question to a service has come to.
enum class ServiceFinding {
  kGone,   // there is no such service
  kAsked,  // it has not answered yet
  kFound   // it is there and has answered, or is not one of those that are asked
};

struct RosAnswer {
  bool ok = false;
  std::string error;         // when ok is false: the container's words, or what was waited for in vain
  bool client_lost = false;  // no answer is possible: launch-ros-client can't be started, or has ended

  std::string node;                 // LoadNode: its full name
  std::uint64_t unique_id = 0;      // LoadNode: its number in the container
  std::vector<std::string> nodes;   // ListNodes: full names …
  std::vector<std::uint64_t> ids;   // … and their numbers
  std::string state;                // GetState, StateReached, WatchTransitions: the state now
  std::string previous_state = {};  // WatchTransitions: the state before

  // StateReached, ParameterReached: what the node says now. Other answers follow, and `ok` is false.
  std::string seen = {};
  std::optional<SeenMessages> messages = {};  // WatchMessages
  std::optional<TopicTraffic> traffic = {};   // MeterTopic
  std::optional<ServiceFinding> found = {};   // AskService, AskState
};

// What the request waits for, for messages: "the '/c/_container/load_node' service", "a publisher of '/scan'".
std::string describe(const RosRequest& request);

class RosClient {
 public:
  using Done = std::function<void(const RosAnswer&)>;

  virtual ~RosClient() = default;

  // Never blocks. `environment` chooses the graph (ROS_DOMAIN_ID and the like). Without an answer within `timeout` the
  // answer is an error; zero waits for ever. `done` is called in a later turn of the loop, once unless the request says
  // otherwise. Destroying the source, which `done` may do, cancels the request.
  [[nodiscard]] virtual EventLoop::SourcePtr ask(const RosRequest& request, const Environment& environment,
                                                 Duration timeout, Done done) = 0;

  // To be called when no more requests will come. Frees what the client holds, without waiting.
  virtual void close() = 0;
};

}  // namespace launch
