// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_client.hpp"

#include <fmt/format.h>

namespace launch {

namespace {

struct Describe {
  static std::string service(const std::string& node, const char* name) {
    return fmt::format("the '{}/{}' service", node, name);
  }
  std::string operator()(const LoadNode& call) const { return service(call.container, "_container/load_node"); }
  std::string operator()(const UnloadNode& call) const { return service(call.container, "_container/unload_node"); }
  std::string operator()(const ListNodes& call) const { return service(call.container, "_container/list_nodes"); }
  std::string operator()(const ChangeState& call) const { return service(call.node, "change_state"); }
  std::string operator()(const GetState& call) const { return service(call.node, "get_state"); }
  std::string operator()(const SetParameters& call) const { return service(call.node, "set_parameters_atomically"); }
  std::string operator()(const NodePresent& wait) const { return fmt::format("the node '{}'", wait.node); }
  std::string operator()(const TopicPresent& wait) const { return fmt::format("a publisher of '{}'", wait.topic); }
  std::string operator()(const ServicePresent& wait) const { return fmt::format("the '{}' service", wait.service); }
  std::string operator()(const MessagePublished& wait) const { return fmt::format("a message on '{}'", wait.topic); }
  std::string operator()(const StateReached& wait) const { return fmt::format("'{}' to be {}", wait.node, wait.state); }
  std::string operator()(const ParameterReached& wait) const {
    return fmt::format("parameter '{}' of '{}' to be {}", wait.parameter.name, wait.node,
                       to_python_text(wait.parameter.value));
  }
  std::string operator()(const WatchMessages& watch) const { return fmt::format("messages on '{}'", watch.topic); }
  std::string operator()(const MeterTopic& watch) const { return fmt::format("the rate of '{}'", watch.topic); }
  std::string operator()(const AskService& watch) const { return fmt::format("answers of '{}'", watch.service); }
  std::string operator()(const AskState& watch) const { return fmt::format("answers of '{}/get_state'", watch.node); }
  std::string operator()(const WatchTransitions& watch) const { return fmt::format("the state of '{}'", watch.node); }
};

}  // namespace

std::string describe(const RosRequest& request) {
  return std::visit(Describe(), request);
}

}  // namespace launch
