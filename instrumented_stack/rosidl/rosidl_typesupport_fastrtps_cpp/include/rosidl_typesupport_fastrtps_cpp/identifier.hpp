// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rosidl_typesupport_fastrtps_cpp {

// Identifies type supports whose data is a message_type_support_callbacks_t or service_type_support_callbacks_t.
// Compare it by content, because each shared library has its own copy.
inline constexpr const char* typesupport_identifier = "rosidl_typesupport_fastrtps_cpp";
// The same for C messages: the callbacks read and write C structures.
inline constexpr const char* typesupport_identifier_of_c = "rosidl_typesupport_fastrtps_c";

}  // namespace rosidl_typesupport_fastrtps_cpp
