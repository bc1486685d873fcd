// SPDX-License-Identifier: Apache-2.0
// Setting param1 also sets param2. Once both are set, the node logs them.
#include <algorithm>
#include <vector>

#include "rcl_interfaces/msg/set_parameters_result.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace demo_nodes_cpp {

class SetParametersCallback : public rclcpp::Node {
 public:
  using Parameters = std::vector<rclcpp::Parameter>;

  explicit SetParametersCallback(const rclcpp::NodeOptions& options) : Node("set_parameters_callback", options) {
    values_[0] = declare_parameter("param1", 0.0);
    values_[1] = declare_parameter("param2", 0.0);
    before_ = add_pre_set_parameters_callback([](Parameters& parameters) {
      const auto is_first = [](const rclcpp::Parameter& parameter) { return parameter.get_name() == "param1"; };
      if (std::any_of(parameters.begin(), parameters.end(), is_first)) {
        parameters.emplace_back("param2", 4.0);
      }
    });
    check_ = add_on_set_parameters_callback([](const Parameters&) {
      rcl_interfaces::msg::SetParametersResult result;
      result.successful = true;
      return result;
    });
    after_ = add_post_set_parameters_callback([this](const Parameters& parameters) {
      for (const rclcpp::Parameter& parameter : parameters) {
        const bool is_first = parameter.get_name() == "param1";
        if (is_first || parameter.get_name() == "param2") {
          values_[is_first ? 0 : 1] = parameter.as_double();
          RCLCPP_INFO(get_logger(), "%s is %f", parameter.get_name().c_str(), parameter.as_double());
        }
      }
    });
  }

 private:
  double values_[2];
  PreSetParametersCallbackHandle::SharedPtr before_;
  OnSetParametersCallbackHandle::SharedPtr check_;
  PostSetParametersCallbackHandle::SharedPtr after_;
};

}  // namespace demo_nodes_cpp

RCLCPP_COMPONENTS_REGISTER_NODE(demo_nodes_cpp::SetParametersCallback)
