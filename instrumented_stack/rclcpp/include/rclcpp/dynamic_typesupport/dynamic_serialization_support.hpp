// SPDX-License-Identifier: Apache-2.0
// Reads and writes messages of types that are made at run time.
#pragma once

#include <rcl/allocator.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "rclcpp/macros.hpp"

namespace rclcpp::dynamic_typesupport {

class DynamicSerializationSupport : public std::enable_shared_from_this<DynamicSerializationSupport> {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(DynamicSerializationSupport)

  // As in rclcpp so far, the constructors throw std::runtime_error.
  explicit DynamicSerializationSupport(rcl_allocator_t allocator = rcl_get_default_allocator())
      : DynamicSerializationSupport("", allocator) {}
  explicit DynamicSerializationSupport(const std::string& /*serialization_library_name*/,
                                       rcl_allocator_t /*allocator*/ = rcl_get_default_allocator()) {
    throw std::runtime_error("Unimplemented");
  }
  virtual ~DynamicSerializationSupport() = default;
  RCLCPP_DISABLE_COPY(DynamicSerializationSupport)
};

}  // namespace rclcpp::dynamic_typesupport
