// SPDX-License-Identifier: Apache-2.0
// The type supports in the library of a package of interfaces, for any middleware.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>

#include <string>

namespace launch {

// `type` is "std_msgs/msg/String", or of a part of a service: "std_srvs/srv/SetBool_Request". The libraries stay
// loaded. Throw std::runtime_error if the package has no such type or no library.
const rosidl_message_type_support_t& installed_message(const std::string& type);
const rosidl_service_type_support_t& installed_service(const std::string& type);

}  // namespace launch
