// SPDX-License-Identifier: Apache-2.0
// Makes a type at run time.
//
// As in rclcpp so far, the class is only a name: no program can make such an object.
#pragma once

#include <memory>

#include "rclcpp/dynamic_typesupport/dynamic_serialization_support.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::dynamic_typesupport {

class DynamicMessageTypeBuilder : public std::enable_shared_from_this<DynamicMessageTypeBuilder> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(DynamicMessageTypeBuilder)

  virtual ~DynamicMessageTypeBuilder() = default;
  RCLCPP_DISABLE_COPY(DynamicMessageTypeBuilder)

 private:
  DynamicMessageTypeBuilder() = default;
};

}  // namespace rclcpp::dynamic_typesupport
