// SPDX-License-Identifier: Apache-2.0
// The structure of a message type, which the content filters of Fast DDS need.
#pragma once

#include "rosidl_runtime_c/type_description.h"

namespace rmw_fastrtps {

// Registers the members of a type with Fast DDS, once per process. Thread safe. Throws std::runtime_error.
void register_type_object(const rosidl_type_description_t& description);

}  // namespace rmw_fastrtps
