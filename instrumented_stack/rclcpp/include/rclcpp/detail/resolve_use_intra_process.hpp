// SPDX-License-Identifier: Apache-2.0
// Whether a publisher or subscription uses intra-process communication.
#pragma once

#include <string>

#include "rclcpp/intra_process_setting.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp::detail {

template <typename OptionsT>
bool resolve_use_intra_process(const OptionsT& options, const node_interfaces::NodeBaseInterface& node_base) {
  return options.use_intra_process_comm == IntraProcessSetting::NodeDefault
             ? node_base.get_use_intra_process_default()
             : options.use_intra_process_comm == IntraProcessSetting::Enable;
}

// Throws std::invalid_argument for the history "keep all" and for a depth of 0.
void require_intra_process_qos(const QoS& qos, const std::string& topic_name);

}  // namespace rclcpp::detail
