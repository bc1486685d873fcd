// SPDX-License-Identifier: Apache-2.0
// The type support of a type of which only the name is known, for subscriptions that take messages as bytes.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>

#include <string>

namespace launch {

// `type` is "std_msgs/msg/String". The reference is valid as long as the program runs. Not for several threads at once.
// Throws std::runtime_error if the middleware can't have the type.
const rosidl_message_type_support_t& opaque_type(const std::string& type);

}  // namespace launch
