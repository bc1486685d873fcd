// SPDX-License-Identifier: Apache-2.0
// Where and when a received message came from.
#pragma once

#include <rmw/types.h>

namespace rclcpp {

class MessageInfo {
 public:
  MessageInfo() = default;
  MessageInfo(const rmw_message_info_t& rmw_message_info)  // NOLINT: the wrapper of its C form
      : rmw_message_info_(rmw_message_info) {}

  const rmw_message_info_t& get_rmw_message_info() const { return rmw_message_info_; }
  rmw_message_info_t& get_rmw_message_info() { return rmw_message_info_; }

 private:
  rmw_message_info_t rmw_message_info_{};
};

}  // namespace rclcpp
