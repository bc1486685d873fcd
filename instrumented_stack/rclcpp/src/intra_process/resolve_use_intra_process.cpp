// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/resolve_use_intra_process.hpp"

#include <stdexcept>

namespace rclcpp::detail {

void require_intra_process_qos(const QoS& qos, const std::string& topic_name) {
  if (qos.history() != HistoryPolicy::KeepLast) {
    throw std::invalid_argument("intraprocess communication on topic '" + topic_name +
                                "' allowed only with keep last history qos policy");
  }
  if (qos.depth() == 0) {
    throw std::invalid_argument("intraprocess communication on topic '" + topic_name +
                                "' is not allowed with a zero qos history depth value");
  }
}

}  // namespace rclcpp::detail
