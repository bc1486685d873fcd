// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_runtime_c/type_description.h"

// The names of a service type and the type supports of its two messages.
typedef struct service_type_support_callbacks_t {
  // "rcl_interfaces::srv"
  const char* service_namespace_;
  // "GetParameters"
  const char* service_name_;
  // The type supports of GetParameters_Request and GetParameters_Response.
  const rosidl_message_type_support_t* request_members_;
  const rosidl_message_type_support_t* response_members_;
  const rosidl_type_description_t* description_;
} service_type_support_callbacks_t;
