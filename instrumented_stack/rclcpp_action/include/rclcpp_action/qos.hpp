// SPDX-License-Identifier: Apache-2.0
// The QoS of the topic that tells the states of an action's goals.
#pragma once

#include <rcl_action/default_qos.h>

#include "rclcpp/qos.hpp"

namespace rclcpp_action {

// One message, reliable and transient local: a client that comes late learns the states of all goals.
class DefaultActionStatusQoS : public rclcpp::QoS {
 public:
  DefaultActionStatusQoS()
      : rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rcl_action_qos_profile_status_default),
                    rcl_action_qos_profile_status_default) {}
};

}  // namespace rclcpp_action
