// SPDX-License-Identifier: Apache-2.0
// Publishes and subscribes with your own type instead of a message type. Specialise TypeAdapter for the pair:
//
//   template <>
//   struct rclcpp::TypeAdapter<std::string, std_msgs::msg::String> {
//     using is_specialized = std::true_type;
//     using custom_type = std::string;
//     using ros_message_type = std_msgs::msg::String;
//     static void convert_to_ros_message(const custom_type& source, ros_message_type& destination) { … }
//     static void convert_to_custom(const ros_message_type& source, custom_type& destination) { … }
//   };
//
// and create publishers and subscriptions of rclcpp::adapt_type<std::string>::as<std_msgs::msg::String>. Within a
// process the custom type is not converted.
#pragma once

#include <type_traits>

namespace rclcpp {

template <typename CustomT, typename ROSMessageT = void, typename EnableT = void>
struct TypeAdapter {
  using is_specialized = std::false_type;
  using custom_type = CustomT;
  // A message type is its own custom type.
  using ros_message_type = CustomT;
};

template <typename T>
struct is_type_adapter : std::false_type {};
template <typename... Ts>
struct is_type_adapter<TypeAdapter<Ts...>> : std::true_type {};

// The adapter itself may be used instead of the custom type.
template <typename T>
struct TypeAdapter<T, void, std::enable_if_t<is_type_adapter<T>::value>> : T {};

template <typename CustomT>
struct adapt_type {
  template <typename ROSMessageT>
  using as = TypeAdapter<CustomT, ROSMessageT>;
};

// Sets the message type of a custom type. The custom type can then be used like a message type.
template <typename CustomT>
struct ImplicitTypeAdapter {
  using is_specialized = std::false_type;
};

template <typename T>
struct TypeAdapter<T, void, std::enable_if_t<ImplicitTypeAdapter<T>::is_specialized::value>> : ImplicitTypeAdapter<T> {
};

#define RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE(CustomType, ROSMessageType)                            \
  template <>                                                                                               \
  struct rclcpp::ImplicitTypeAdapter<CustomType> : public rclcpp::TypeAdapter<CustomType, ROSMessageType> { \
    static_assert(is_specialized::value,                                                                    \
                  "Cannot use custom type as ros type when there is no TypeAdapter for that pair");         \
  }

}  // namespace rclcpp
