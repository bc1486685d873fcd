// SPDX-License-Identifier: Apache-2.0
// The structure of a message type, as the content filters of Fast DDS need it.
#pragma once

#include "rosidl_runtime_c/type_description.h"

namespace rmw_fastrtps {

// Tells Fast DDS the members of a type, once and for the rest of the process. Thread safe. Throws std::runtime_error.
void register_type_object(const rosidl_type_description_t& description);

}  // namespace rmw_fastrtps
