// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/get_type_support.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_message_type_support_t rosidl_message_type_support_t;

// Returns the type support with the requested identifier; null if `handle` cannot provide it.
typedef const rosidl_message_type_support_t* (*rosidl_message_typesupport_handle_function)(
    const rosidl_message_type_support_t* handle, const char* identifier);

// The facts about a message type that a middleware needs. It has static storage duration.
struct rosidl_message_type_support_t {
  // Tells what `data` is; here it is rosidl_typesupport_fastrtps_cpp's identifier for
  // message_type_support_callbacks_t.
  const char* typesupport_identifier;
  const void* data;
  rosidl_message_typesupport_handle_function func;
};

static inline const rosidl_message_type_support_t* get_message_typesupport_handle(
    const rosidl_message_type_support_t* handle, const char* identifier) {
  return handle->func(handle, identifier);
}

#ifdef __cplusplus
}
#endif
