// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/contexts/default_context.hpp"

#include <memory>

namespace rclcpp::contexts {

DefaultContext::SharedPtr get_global_default_context() {
  static const auto context = std::make_shared<DefaultContext>();
  return context;
}

}  // namespace rclcpp::contexts
