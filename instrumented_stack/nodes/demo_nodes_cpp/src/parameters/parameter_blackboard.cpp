// SPDX-License-Identifier: Apache-2.0
// Keeps any parameters it is given. Every node can read and write them.
#include "rcl_interfaces/srv/list_parameters.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class ParameterBlackboard : public rclcpp::Node {
 public:
  explicit ParameterBlackboard(rclcpp::NodeOptions options)
      : Node("parameter_blackboard",
             options.allow_undeclared_parameters(true).automatically_declare_parameters_from_overrides(true)) {
    const auto listed = list_parameters({}, rcl_interfaces::srv::ListParameters::Request::DEPTH_RECURSIVE);
    RCLCPP_INFO(get_logger(), "Parameter blackboard node named '%s' ready, and serving '%zu' parameters already!",
                get_fully_qualified_name(), listed.names.size());
  }
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::ParameterBlackboard)
