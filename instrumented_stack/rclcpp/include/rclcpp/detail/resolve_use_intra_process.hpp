// SPDX-License-Identifier: Apache-2.0
// Whether a publisher or subscription uses intra-process communication.
#pragma once

#include <stdexcept>
#include <string>

#include "rclcpp/intra_process_setting.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp::detail {

template <typename OptionsT>
bool resolve_use_intra_process(const OptionsT& options, const node_interfaces::NodeBaseInterface& node_base) {
  switch (options.use_intra_process_comm) {
    case IntraProcessSetting::Enable:
      return true;
    case IntraProcessSetting::Disable:
      return false;
    case IntraProcessSetting::NodeDefault:
      return node_base.get_use_intra_process_default();
  }
  throw std::runtime_error("Unrecognized IntraProcessSetting value");
}

// Throws std::invalid_argument for the history "keep all" and for a depth of 0.
void require_intra_process_qos(const QoS& qos, const std::string& topic_name);

}  // namespace rclcpp::detail
