// SPDX-License-Identifier: Apache-2.0
// Messages of types that are known only at run time.
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

// A message with the defaults of its type; null, with the error set, if the type support cannot make one.
void* rmw_create_message(const rosidl_message_type_support_t* type_support);
void rmw_destroy_message(const rosidl_message_type_support_t* type_support, void* ros_message);

#ifdef __cplusplus
}
#endif
