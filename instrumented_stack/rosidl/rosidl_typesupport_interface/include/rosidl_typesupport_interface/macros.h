// SPDX-License-Identifier: Apache-2.0
// The names of the functions that return type supports, such as
// rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__String.
#pragma once

#define ROSIDL_TYPESUPPORT_INTERFACE__LIBRARY_NAME(typesupport_name, package_name) package_name##__##typesupport_name

#define ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME(typesupport_name, function_name, package_name, interface_type, \
                                                  interface_name)                                                \
  typesupport_name##__##function_name##__##package_name##__##interface_type##__##interface_name

#define ROSIDL_TYPESUPPORT_INTERFACE__MESSAGE_SYMBOL_NAME(typesupport_name, package_name, interface_type,    \
                                                          message_name)                                      \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME(typesupport_name, get_message_type_support_handle, package_name, \
                                            interface_type, message_name)

#define ROSIDL_TYPESUPPORT_INTERFACE__SERVICE_SYMBOL_NAME(typesupport_name, package_name, interface_type,    \
                                                          service_name)                                      \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME(typesupport_name, get_service_type_support_handle, package_name, \
                                            interface_type, service_name)

#define ROSIDL_TYPESUPPORT_INTERFACE__ACTION_SYMBOL_NAME(typesupport_name, package_name, interface_type, action_name) \
  ROSIDL_TYPESUPPORT_INTERFACE__SYMBOL_NAME(typesupport_name, get_action_type_support_handle, package_name,           \
                                            interface_type, action_name)
