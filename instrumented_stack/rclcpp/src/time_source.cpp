#include "time_source.hpp"

#include "rclcpp/exceptions.hpp"

namespace rclcpp::node_interfaces {

namespace {

constexpr const char* kParameter = "use_sim_time";

void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

}  // namespace

TimeSource::TimeSource(Node& node) : node_(node), clock_(node.get_clock()) {
  if (!node.has_parameter(kParameter)) {
    node.declare_parameter(kParameter, false);
  }
  use_sim_time(node.get_parameter(kParameter).as_bool());
  parameter_callback_ = node.add_post_set_parameters_callback([this](const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) {
      if (parameter.get_name() == kParameter && parameter.get_type() == PARAMETER_BOOL) {
        use_sim_time(parameter.as_bool());
      }
    }
  });
}

void TimeSource::use_sim_time(bool enabled) {
  if (clock_->get_clock_type() != RCL_ROS_TIME || enabled == (subscription_ != nullptr)) {
    return;
  }
  {
    const std::lock_guard lock(clock_->get_clock_mutex());
    if (enabled) {
      require_ok(rcl_enable_ros_time_override(clock_->get_clock_handle()), "failed to enable simulated time");
    } else {
      require_ok(rcl_disable_ros_time_override(clock_->get_clock_handle()), "failed to disable simulated time");
    }
  }
  if (enabled) {
    subscription_ = node_.create_subscription<rosgraph_msgs::msg::Clock>(
        "/clock", ClockQoS(), [this](const rosgraph_msgs::msg::Clock& message) { set_time(message); });
  } else {
    subscription_.reset();
  }
}

void TimeSource::set_time(const rosgraph_msgs::msg::Clock& message) {
  const std::lock_guard lock(clock_->get_clock_mutex());
  require_ok(rcl_set_ros_time_override(clock_->get_clock_handle(), Time(message.clock).nanoseconds()),
             "failed to set simulated time");
}

}  // namespace rclcpp::node_interfaces
