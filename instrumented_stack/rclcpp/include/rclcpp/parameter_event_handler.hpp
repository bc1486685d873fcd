// SPDX-License-Identifier: Apache-2.0
// Calls back when parameters change, those of the own node and of others.
//
//   auto handler = std::make_shared<rclcpp::ParameterEventHandler>(node);
//   auto handle = handler->add_parameter_callback("rate", [](const rclcpp::Parameter& p) { … }, "/other_node");
//
// Callbacks run in the thread that spins the node, as long as their handle lives. The last one added runs first.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <string>
#include <vector>

#include "rclcpp/create_subscription.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/subscription.hpp"

namespace rclcpp {

struct ParameterCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterCallbackHandle)
  using ParameterCallbackType = std::function<void(const Parameter&)>;

  std::string parameter_name;
  std::string node_name;
  ParameterCallbackType callback;
};

struct ParameterEventCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterEventCallbackHandle)
  using ParameterEventCallbackType = std::function<void(const rcl_interfaces::msg::ParameterEvent&)>;

  ParameterEventCallbackType callback;
};

// Thread safe.
class ParameterEventHandler {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ParameterEventHandler)
  using ParameterCallbackType = ParameterCallbackHandle::ParameterCallbackType;
  using ParameterEventCallbackType = ParameterEventCallbackHandle::ParameterEventCallbackType;

  // `node` is a node or a pointer to one.
  template <typename NodeT>
  explicit ParameterEventHandler(NodeT&& node, const QoS& qos = ParameterEventsQoS())
      : node_base_(node_interfaces::dereferenced(node).get_node_base_interface()),
        callbacks_(std::make_shared<Callbacks>()),
        subscription_(create_subscription<rcl_interfaces::msg::ParameterEvent>(
            node, "/parameter_events", qos, [callbacks = callbacks_](const rcl_interfaces::msg::ParameterEvent& event) {
              callbacks->event_callback(event);
            })) {}

  // Called for every event, after the callbacks for single parameters.
  [[nodiscard]] ParameterEventCallbackHandle::SharedPtr add_parameter_event_callback(
      ParameterEventCallbackType callback);
  // Throws std::runtime_error if the handle is not registered.
  void remove_parameter_event_callback(const ParameterEventCallbackHandle::SharedPtr& handle);

  // Called for new and changed values of a parameter. A node name without a leading slash is in the own namespace. An
  // empty name means the own node.
  [[nodiscard]] ParameterCallbackHandle::SharedPtr add_parameter_callback(const std::string& parameter_name,
                                                                          ParameterCallbackType callback,
                                                                          const std::string& node_name = "");
  // Throws std::runtime_error if the handle is not registered.
  void remove_parameter_callback(const ParameterCallbackHandle::SharedPtr& handle);

  // Lets only events of these nodes come, so that those of others are not even sent. Names as in
  // add_parameter_callback(), each once; an empty list lets all come. Callbacks of other nodes stay, and are not
  // called. Returns whether it is so: false if the node uses intra-process communication.
  bool configure_nodes_filter(const std::vector<std::string>& node_names);

  // Whether `event` has a new or changed value of that parameter and node. The node's name is fully qualified.
  static bool get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event, Parameter& parameter,
                                       const std::string& parameter_name, const std::string& node_name = "");
  // Without a value if the event of that node has none. Throws std::runtime_error for an event of another node.
  static Parameter get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event,
                                            const std::string& parameter_name, const std::string& node_name = "");
  // New parameters first, then changed ones.
  static std::vector<Parameter> get_parameters_from_event(const rcl_interfaces::msg::ParameterEvent& event);

 protected:
  // As in rclcpp, derived classes may look at the callbacks, and call them with an event of their own.
  struct Callbacks {
    // Callbacks may add and remove callbacks.
    std::recursive_mutex mutex;
    std::list<ParameterCallbackHandle::WeakPtr> parameter_callbacks_;
    std::list<ParameterEventCallbackHandle::WeakPtr> event_callbacks_;

    void event_callback(const rcl_interfaces::msg::ParameterEvent& event);
  };

  node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  std::shared_ptr<Callbacks> callbacks_;

 private:
  std::string full_name(const std::string& node_name) const;

  Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr subscription_;
};

}  // namespace rclcpp
