// SPDX-License-Identifier: Apache-2.0
// A message of a type that is made at run time.
//
// As in rclcpp so far, the class is only a name: no program can make such an object.
#pragma once

#include <memory>

#include "rclcpp/dynamic_typesupport/dynamic_message_type.hpp"
#include "rclcpp/dynamic_typesupport/dynamic_serialization_support.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::dynamic_typesupport {

class DynamicMessage : public std::enable_shared_from_this<DynamicMessage> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(DynamicMessage)

  virtual ~DynamicMessage() = default;
  RCLCPP_DISABLE_COPY(DynamicMessage)

 private:
  DynamicMessage() = default;
};

}  // namespace rclcpp::dynamic_typesupport
