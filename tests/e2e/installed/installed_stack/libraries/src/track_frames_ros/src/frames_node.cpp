// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_components/register_node_macro.hpp"
#include "track_frames_ros/listener.hpp"

namespace track_frames_ros {

// Sends the frame that its parameters name, once; parameters are read-only from then on.
class StaticFrameNode final : public rclcpp::Node {
 public:
  explicit StaticFrameNode(const rclcpp::NodeOptions& options) : rclcpp::Node("static_frame", options) {
    rcl_interfaces::msg::ParameterDescriptor read_only;
    read_only.read_only = true;
    geometry_msgs::msg::TransformStamped transform;
    transform.header.stamp = now();
    transform.header.frame_id = declare_parameter("frame_id", "/frame", read_only);
    transform.child_frame_id = declare_parameter("child_frame_id", "/child", read_only);
    transform.transform.translation.x = declare_parameter("translation.x", 0.0, read_only);
    handle_ = add_on_set_parameters_callback([](const std::vector<rclcpp::Parameter>& parameters) {
      rcl_interfaces::msg::SetParametersResult result;
      result.successful = parameters.empty();
      return result;
    });
    broadcaster_.send(transform);
  }

 private:
  Broadcaster broadcaster_{*this, true};
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr handle_;
};

}  // namespace track_frames_ros

RCLCPP_COMPONENTS_REGISTER_NODE(track_frames_ros::StaticFrameNode)
