// SPDX-License-Identifier: Apache-2.0
// Accepts only parameters that are even numbers.
#include <string>
#include <vector>

#include "rcl_interfaces/msg/set_parameters_result.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class EvenParameterNode : public rclcpp::Node {
 public:
  explicit EvenParameterNode(rclcpp::NodeOptions options)
      : Node("even_parameters_node", options.allow_undeclared_parameters(true)) {
    callback_ = add_on_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& parameters) { return check(parameters); });
  }

 private:
  rcl_interfaces::msg::SetParametersResult check(const std::vector<rclcpp::Parameter>& parameters) const {
    rcl_interfaces::msg::SetParametersResult result;
    result.successful = true;
    for (const rclcpp::Parameter& parameter : parameters) {
      const std::string& name = parameter.get_name();
      if (parameter.get_type() == rclcpp::PARAMETER_NOT_SET) {
        RCLCPP_INFO(get_logger(), "parameter '%s' deleted successfully", name.c_str());
      } else if (parameter.get_type() != rclcpp::PARAMETER_INTEGER) {
        RCLCPP_INFO(get_logger(), "requested value for parameter '%s' is not an integer, rejecting change...",
                    name.c_str());
        result.reason = "only integers can be set";
        result.successful = false;
      } else if (parameter.as_int() % 2 != 0) {
        RCLCPP_INFO(get_logger(), "Requested value '%s' for parameter '%s' is not an even number: rejecting change...",
                    parameter.value_to_string().c_str(), name.c_str());
        result.reason = "only even integers can be set";
        result.successful = false;
      } else {
        RCLCPP_INFO(get_logger(), "parameter '%s' has changed and is now: %s", name.c_str(),
                    parameter.value_to_string().c_str());
      }
    }
    return result;
  }

  OnSetParametersCallbackHandle::SharedPtr callback_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::EvenParameterNode)
