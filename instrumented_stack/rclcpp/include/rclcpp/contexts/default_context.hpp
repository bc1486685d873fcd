// SPDX-License-Identifier: Apache-2.0
// The context that rclcpp::init() initialises. Everything uses it by default.
#pragma once

#include "rclcpp/context.hpp"

namespace rclcpp::contexts {

class DefaultContext : public Context {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(DefaultContext)
  DefaultContext() = default;
};

DefaultContext::SharedPtr get_global_default_context();

}  // namespace rclcpp::contexts
