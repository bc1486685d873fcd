// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/service_type_support_struct.h"

namespace rosidl_typesupport_cpp {

// The type support of service type T; every interface package specialises it for its types. Never null.
template <typename T>
const rosidl_service_type_support_t* get_service_type_support_handle();

}  // namespace rosidl_typesupport_cpp
