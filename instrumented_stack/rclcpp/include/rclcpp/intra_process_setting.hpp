// SPDX-License-Identifier: Apache-2.0
// Whether a publisher or subscription uses the short way to its counterparts in the same context.
#pragma once

namespace rclcpp {

enum class IntraProcessSetting {
  Enable,
  Disable,
  NodeDefault,  // NodeOptions::use_intra_process_comms()
};

}  // namespace rclcpp
