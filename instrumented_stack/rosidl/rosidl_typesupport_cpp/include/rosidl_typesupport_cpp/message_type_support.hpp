// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"

namespace rosidl_typesupport_cpp {

// The type support of message type T; every message package specialises it for its types. Never null.
template <typename T>
const rosidl_message_type_support_t* get_message_type_support_handle();

}  // namespace rosidl_typesupport_cpp
