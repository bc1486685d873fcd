// SPDX-License-Identifier: Apache-2.0
#include "programs/ros_client/opaque_subscription.hpp"

#include <rclcpp/exceptions.hpp>

#include "programs/type_supports/opaque_type.hpp"

namespace launch {

OpaqueSubscription::OpaqueSubscription(rclcpp::Node& node, const std::string& topic, const std::string& type,
                                       const rclcpp::QoS& qos)
    : node_(node.get_node_base_interface()->get_shared_rcl_node_handle()) {
  rcl_subscription_options_t options = rcl_subscription_get_default_options();
  options.qos = qos.get_rmw_qos_profile();
  const rcl_ret_t ret = rcl_subscription_init(&subscription_, node_.get(), &opaque_type(type), topic.c_str(), &options);
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "could not subscribe to '" + topic + "'");
  }
}

OpaqueSubscription::~OpaqueSubscription() {
  (void)rcl_subscription_fini(&subscription_, node_.get());
}

std::optional<OpaqueSubscription::Message> OpaqueSubscription::take() {
  Message message;
  if (rcl_take_serialized_message(&subscription_, &message.bytes.get_rcl_serialized_message(), &message.info,
                                  nullptr) == RCL_RET_OK) {
    return message;
  }
  rcl_reset_error();
  return std::nullopt;
}

}  // namespace launch
