// SPDX-License-Identifier: Apache-2.0
// Whether a publisher or subscription uses intra-process communication within its context.
#pragma once

namespace rclcpp {

enum class IntraProcessSetting {
  Enable,
  Disable,
  NodeDefault,  // as in NodeOptions::use_intra_process_comms()
};

}  // namespace rclcpp
