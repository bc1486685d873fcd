// SPDX-License-Identifier: Apache-2.0
// NodeInterfaces: the interfaces that a function needs of a node, so that it accepts nodes of every class.
//
//   using Interfaces = rclcpp::node_interfaces::NodeInterfaces<NodeBaseInterface, NodeLoggingInterface>;
//   void inspect(Interfaces node) { RCLCPP_INFO(node.get_node_logging_interface()->get_logger(), "…"); }
//   inspect(*my_lifecycle_node);
#pragma once

#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_clock_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_interfaces/node_time_source_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/node_interfaces/node_type_descriptions_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"

// All interfaces of a node: NodeInterfaces<ALL_RCLCPP_NODE_INTERFACES>.
#define ALL_RCLCPP_NODE_INTERFACES                                                                          \
  rclcpp::node_interfaces::NodeBaseInterface, rclcpp::node_interfaces::NodeClockInterface,                  \
      rclcpp::node_interfaces::NodeGraphInterface, rclcpp::node_interfaces::NodeLoggingInterface,           \
      rclcpp::node_interfaces::NodeParametersInterface, rclcpp::node_interfaces::NodeServicesInterface,     \
      rclcpp::node_interfaces::NodeTimeSourceInterface, rclcpp::node_interfaces::NodeTimersInterface,       \
      rclcpp::node_interfaces::NodeTopicsInterface, rclcpp::node_interfaces::NodeTypeDescriptionsInterface, \
      rclcpp::node_interfaces::NodeWaitablesInterface

namespace rclcpp::node_interfaces {

namespace detail {

// How to get an interface from a node, and the getter for it in NodeInterfaces.
template <typename InterfaceT, typename InterfacesT>
struct NodeInterfaceAccess;

#define RCLCPP_NODE_INTERFACE_ACCESS_(Interface, getter)                       \
  template <typename InterfacesT>                                              \
  struct NodeInterfaceAccess<Interface, InterfacesT> {                         \
    template <typename NodeT>                                                  \
    static std::shared_ptr<Interface> of(NodeT& node) {                        \
      return node.getter();                                                    \
    }                                                                          \
    std::shared_ptr<Interface> getter() {                                      \
      return static_cast<InterfacesT&>(*this).template get<Interface>();       \
    }                                                                          \
    std::shared_ptr<const Interface> getter() const {                          \
      return static_cast<const InterfacesT&>(*this).template get<Interface>(); \
    }                                                                          \
  };
RCLCPP_NODE_INTERFACE_ACCESS_(NodeBaseInterface, get_node_base_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeClockInterface, get_node_clock_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeGraphInterface, get_node_graph_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeLoggingInterface, get_node_logging_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeParametersInterface, get_node_parameters_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeServicesInterface, get_node_services_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeTimeSourceInterface, get_node_time_source_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeTimersInterface, get_node_timers_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeTopicsInterface, get_node_topics_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeTypeDescriptionsInterface, get_node_type_descriptions_interface)
RCLCPP_NODE_INTERFACE_ACCESS_(NodeWaitablesInterface, get_node_waitables_interface)
#undef RCLCPP_NODE_INTERFACE_ACCESS_

template <typename T, typename EnableT = void>
struct HasNodeBase : std::false_type {};
template <typename T>
struct HasNodeBase<T, std::void_t<decltype(std::declval<T&>().get_node_base_interface())>> : std::true_type {};

}  // namespace detail

template <typename... InterfaceTs>
class NodeInterfaces : public detail::NodeInterfaceAccess<InterfaceTs, NodeInterfaces<InterfaceTs...>>... {
  static_assert(sizeof...(InterfaceTs) > 0, "NodeInterfaces needs at least one interface");

 public:
  // All interfaces are null.
  NodeInterfaces() = default;

  // Takes the interfaces from a node, or from other NodeInterfaces that have them.
  template <typename NodeT,
            typename = std::enable_if_t<!std::is_same_v<std::decay_t<NodeT>, NodeInterfaces> &&
                                        (detail::HasNodeBase<NodeT>::value || std::is_class_v<std::decay_t<NodeT>>)&&!(
                                            std::is_same_v<std::decay_t<NodeT>, std::shared_ptr<InterfaceTs>> || ...)>>
  NodeInterfaces(NodeT&& node)  // NOLINT: nodes become interfaces where a function is called
      : interfaces_(detail::NodeInterfaceAccess<InterfaceTs, NodeInterfaces>::of(node)...) {}

  NodeInterfaces(std::shared_ptr<InterfaceTs>... interfaces)  // NOLINT: as ROS 2's
      : interfaces_(std::move(interfaces)...) {}

  template <typename InterfaceT>
  std::shared_ptr<InterfaceT> get() {
    return std::get<std::shared_ptr<InterfaceT>>(interfaces_);
  }
  template <typename InterfaceT>
  std::shared_ptr<const InterfaceT> get() const {
    return std::get<std::shared_ptr<InterfaceT>>(interfaces_);
  }
  template <typename InterfaceT>
  void set(std::shared_ptr<InterfaceT> interface) {
    std::get<std::shared_ptr<InterfaceT>>(interfaces_) = std::move(interface);
  }

 private:
  std::tuple<std::shared_ptr<InterfaceTs>...> interfaces_;
};

}  // namespace rclcpp::node_interfaces
