// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_runtime_c/type_description.h"

// The type supports of the services and messages that carry an action. It has static storage duration.
typedef struct rosidl_action_type_support_t {
  const rosidl_service_type_support_t* goal_service_type_support;
  const rosidl_service_type_support_t* result_service_type_support;
  const rosidl_service_type_support_t* cancel_service_type_support;
  const rosidl_message_type_support_t* feedback_message_type_support;
  const rosidl_message_type_support_t* status_message_type_support;
  const rosidl_type_description_t* description;
} rosidl_action_type_support_t;
