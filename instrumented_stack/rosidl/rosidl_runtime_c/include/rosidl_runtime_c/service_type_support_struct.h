// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdint.h>

#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_service_type_support_t rosidl_service_type_support_t;

// Returns the type support with the requested identifier; null if `handle` cannot provide it.
typedef const rosidl_service_type_support_t* (*rosidl_service_typesupport_handle_function)(
    const rosidl_service_type_support_t* handle, const char* identifier);

// An event in a call of a service: the fields of service_msgs/msg/ServiceEventInfo.
typedef struct rosidl_service_introspection_info_s {
  uint8_t event_type;
  int32_t stamp_sec;
  uint32_t stamp_nanosec;
  uint8_t client_gid[16];
  int64_t sequence_number;
} rosidl_service_introspection_info_t;

// Creates an event message of the service with `info` and copies of the messages that are not null. Returns null if
// memory runs out.
typedef void* (*rosidl_service_introspection_event_create_function)(const rosidl_service_introspection_info_t* info,
                                                                    const void* request_message,
                                                                    const void* response_message);

typedef void (*rosidl_service_introspection_event_destroy_function)(void* event_message);

// The facts about a service type that a middleware needs. It has static storage duration.
struct rosidl_service_type_support_t {
  // Tells what `data` is; here it is rosidl_typesupport_fastrtps_cpp's identifier for
  // service_type_support_callbacks_t.
  const char* typesupport_identifier;
  const void* data;
  rosidl_service_typesupport_handle_function func;
  const rosidl_message_type_support_t* request_typesupport;
  const rosidl_message_type_support_t* response_typesupport;
  // The type support of the event message about calls, and the function that creates one.
  const rosidl_message_type_support_t* event_typesupport;
  rosidl_service_introspection_event_create_function event_message_create_handle_function;
  rosidl_service_introspection_event_destroy_function event_message_destroy_handle_function;
};

static inline const rosidl_service_type_support_t* get_service_typesupport_handle(
    const rosidl_service_type_support_t* handle, const char* identifier) {
  return handle->func(handle, identifier);
}

#ifdef __cplusplus
}
#endif
