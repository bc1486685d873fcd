// SPDX-License-Identifier: Apache-2.0
// The type supports of the messages and services of parameters.
#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>
#include <rosidl_runtime_c/service_type_support_struct.h>

#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <rosidl_typesupport_cpp/service_type_support.hpp>

namespace rclcpp::type_support {

const rosidl_message_type_support_t* get_parameter_event_msg_type_support();
const rosidl_message_type_support_t* get_set_parameters_result_msg_type_support();
const rosidl_message_type_support_t* get_parameter_descriptor_msg_type_support();
const rosidl_message_type_support_t* get_list_parameters_result_msg_type_support();
const rosidl_service_type_support_t* get_get_parameters_srv_type_support();
const rosidl_service_type_support_t* get_get_parameter_types_srv_type_support();
const rosidl_service_type_support_t* get_set_parameters_srv_type_support();
const rosidl_service_type_support_t* get_list_parameters_srv_type_support();
const rosidl_service_type_support_t* get_describe_parameters_srv_type_support();
const rosidl_service_type_support_t* get_set_parameters_atomically_srv_type_support();

}  // namespace rclcpp::type_support
