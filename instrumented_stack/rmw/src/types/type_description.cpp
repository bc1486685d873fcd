// SPDX-License-Identifier: Apache-2.0
#include "rmw/type_description.h"

#include "rosidl_typesupport_fastrtps_cpp/find_callbacks.hpp"

using rosidl_typesupport_fastrtps_cpp::find_callbacks;

const rosidl_type_description_t* rmw_message_type_description(const rosidl_message_type_support_t* type_support) {
  const auto* callbacks = find_callbacks(type_support);
  return callbacks == nullptr ? nullptr : callbacks->description_;
}

const rosidl_type_description_t* rmw_service_type_description(const rosidl_service_type_support_t* type_support) {
  const auto* callbacks = find_callbacks(type_support);
  return callbacks == nullptr ? nullptr : callbacks->description_;
}
