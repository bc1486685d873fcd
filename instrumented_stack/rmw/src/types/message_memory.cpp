// SPDX-License-Identifier: Apache-2.0
#include "rmw/message_memory.h"

#include <stdexcept>

#include "rmw/error_handling.h"
#include "types/message_type.hpp"

void* rmw_create_message(const rosidl_message_type_support_t* type_support) try {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, nullptr);
  return rmw_fastrtps::callbacks_of(type_support).create_message();
} catch (const std::exception& error) {
  RMW_SET_ERROR_MSG(error.what());
  return nullptr;
}

void rmw_destroy_message(const rosidl_message_type_support_t* type_support, void* ros_message) {
  rmw_fastrtps::callbacks_of(type_support).destroy_message(ros_message);
}
