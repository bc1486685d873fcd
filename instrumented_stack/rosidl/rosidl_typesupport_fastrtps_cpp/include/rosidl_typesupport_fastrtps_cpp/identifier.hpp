// SPDX-License-Identifier: Apache-2.0
#ifndef ROSIDL_TYPESUPPORT_FASTRTPS_CPP__IDENTIFIER_HPP_
#define ROSIDL_TYPESUPPORT_FASTRTPS_CPP__IDENTIFIER_HPP_

namespace rosidl_typesupport_fastrtps_cpp {

/// Identifies type supports whose data is a message_type_support_callbacks_t or service_type_support_callbacks_t.
/// Compare it by content, because each shared library has its own copy.
inline constexpr const char* typesupport_identifier = "rosidl_typesupport_fastrtps_cpp";

}  // namespace rosidl_typesupport_fastrtps_cpp

#endif  // ROSIDL_TYPESUPPORT_FASTRTPS_CPP__IDENTIFIER_HPP_
