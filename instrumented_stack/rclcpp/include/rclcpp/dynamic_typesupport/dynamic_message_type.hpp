// SPDX-License-Identifier: Apache-2.0
// A type that is made at run time.
//
// As in rclcpp so far, the class is only a name: no program can make such an object.
#pragma once

#include <memory>

#include "rclcpp/dynamic_typesupport/dynamic_serialization_support.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::dynamic_typesupport {

class DynamicMessageType : public std::enable_shared_from_this<DynamicMessageType> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(DynamicMessageType)

  virtual ~DynamicMessageType() = default;
  RCLCPP_DISABLE_COPY(DynamicMessageType)

 private:
  DynamicMessageType() = default;
};

}  // namespace rclcpp::dynamic_typesupport
