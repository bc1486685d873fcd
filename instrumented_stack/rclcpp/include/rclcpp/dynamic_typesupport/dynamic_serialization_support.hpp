// SPDX-License-Identifier: Apache-2.0
// Types that are made at run time. As in rclcpp so far, the classes are only names: no program can make such an object.
#pragma once

#include <rcl/allocator.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "rclcpp/macros.hpp"

namespace rclcpp::dynamic_typesupport {

// Reads and writes messages of such types.
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

#define RCLCPP_ONLY_A_NAME_(Class)                           \
  class Class : public std::enable_shared_from_this<Class> { \
   public:                                                   \
    RCLCPP_SMART_PTR_ALIASES_ONLY(Class)                     \
                                                             \
    virtual ~Class() = default;                              \
    RCLCPP_DISABLE_COPY(Class)                               \
                                                             \
   private:                                                  \
    Class() = default;                                       \
  };
RCLCPP_ONLY_A_NAME_(DynamicMessage)
RCLCPP_ONLY_A_NAME_(DynamicMessageType)
RCLCPP_ONLY_A_NAME_(DynamicMessageTypeBuilder)
RCLCPP_ONLY_A_NAME_(DynamicMessageTypeSupport)
#undef RCLCPP_ONLY_A_NAME_

}  // namespace rclcpp::dynamic_typesupport
