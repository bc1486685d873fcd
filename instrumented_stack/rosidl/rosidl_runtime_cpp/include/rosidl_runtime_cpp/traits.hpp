// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

// Facts about message and service types, specialised by the generated code of each interface package.
namespace rosidl_generator_traits {

// "std_msgs::msg::String"
template <typename T>
const char* data_type();

// "std_msgs/msg/String"
template <typename T>
const char* name();

template <typename T>
struct is_message : std::false_type {};

template <typename T>
struct is_service : std::false_type {};

// T is the request, or the response, of a service.
template <typename T>
struct is_service_request : std::false_type {};
template <typename T>
struct is_service_response : std::false_type {};

template <typename T>
struct is_action : std::false_type {};

// T is a part of an action.
template <typename T>
struct is_action_goal : std::false_type {};
template <typename T>
struct is_action_result : std::false_type {};
template <typename T>
struct is_action_feedback : std::false_type {};

// Every object of the type has the same serialised size.
template <typename T>
struct has_fixed_size : std::false_type {};

// The serialised size has an upper bound.
template <typename T>
struct has_bounded_size : std::false_type {};

// Converts the message to YAML. The generated function has more options; it is found through its argument's type.
template <typename Message, typename = std::enable_if_t<is_message<Message>::value>>
std::string to_yaml(const Message& message) {
  return to_yaml(message, false);
}

}  // namespace rosidl_generator_traits
