// SPDX-License-Identifier: Apache-2.0
#include "rmw/type_description.h"

#include "rosidl_typesupport_fastrtps_cpp/identifier.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "rosidl_typesupport_fastrtps_cpp/service_type_support.h"

using rosidl_typesupport_fastrtps_cpp::typesupport_identifier;

const rosidl_type_description_t* rmw_message_type_description(const rosidl_message_type_support_t* type_support) {
  const auto* found = get_message_typesupport_handle(type_support, typesupport_identifier);
  return found == nullptr ? nullptr : static_cast<const message_type_support_callbacks_t*>(found->data)->description_;
}

const rosidl_type_description_t* rmw_service_type_description(const rosidl_service_type_support_t* type_support) {
  const auto* found = get_service_typesupport_handle(type_support, typesupport_identifier);
  return found == nullptr ? nullptr : static_cast<const service_type_support_callbacks_t*>(found->data)->description_;
}
