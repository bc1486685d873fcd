#include <rclcpp_components/register_node_macro.hpp>

#include "arm_driver/arm_model.hpp"

namespace arm_driver {

class ArmComponent : public rclcpp::Node {
 public:
  explicit ArmComponent(const rclcpp::NodeOptions& options) : Node("arm_component", options) {}
};

}  // namespace arm_driver

RCLCPP_COMPONENTS_REGISTER_NODE(arm_driver::ArmComponent)
