// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>

#include "rosidl_typesupport_fastrtps_cpp/identifier.hpp"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"
#include "rosidl_typesupport_fastrtps_cpp/service_type_support.h"

namespace rosidl_typesupport_fastrtps_cpp {

// The callbacks of a C++ or a C message; null if the type support has neither.
inline const message_type_support_callbacks_t* find_callbacks(const rosidl_message_type_support_t* type_support) {
  for (const char* identifier : {typesupport_identifier, typesupport_identifier_of_c}) {
    if (const auto* found = get_message_typesupport_handle(type_support, identifier)) {
      return static_cast<const message_type_support_callbacks_t*>(found->data);
    }
  }
  return nullptr;
}

// The same for a service.
inline const service_type_support_callbacks_t* find_callbacks(const rosidl_service_type_support_t* type_support) {
  for (const char* identifier : {typesupport_identifier, typesupport_identifier_of_c}) {
    if (const auto* found = get_service_typesupport_handle(type_support, identifier)) {
      return static_cast<const service_type_support_callbacks_t*>(found->data);
    }
  }
  return nullptr;
}

}  // namespace rosidl_typesupport_fastrtps_cpp
