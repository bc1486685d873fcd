// SPDX-License-Identifier: Apache-2.0
// What a type support tells and does without an endpoint: the description of the type, and the memory of a message.
#include <stdexcept>

#include "rmw/error_handling.h"
#include "rmw/message_memory.h"
#include "rmw/type_description.h"
#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"
#include "types/message_type.hpp"

using rosidl_typesupport_fastrtps_cpp::find_callbacks;

const rosidl_type_description_t* rmw_message_type_description(const rosidl_message_type_support_t* type_support) {
  const auto* callbacks = find_callbacks(type_support);
  return callbacks == nullptr ? nullptr : callbacks->description_;
}

const rosidl_type_description_t* rmw_service_type_description(const rosidl_service_type_support_t* type_support) {
  const auto* callbacks = find_callbacks(type_support);
  return callbacks == nullptr ? nullptr : callbacks->description_;
}

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
