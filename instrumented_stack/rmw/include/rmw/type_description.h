// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/service_type_support_struct.h"
#include "rosidl_runtime_c/type_description.h"

#ifdef __cplusplus
extern "C" {
#endif

// The type definition held by a type support; null if only the name of the type is known. May be called from any
// thread.
const rosidl_type_description_t* rmw_message_type_description(const rosidl_message_type_support_t* type_support);
const rosidl_type_description_t* rmw_service_type_description(const rosidl_service_type_support_t* type_support);

#ifdef __cplusplus
}
#endif
