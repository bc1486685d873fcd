// SPDX-License-Identifier: Apache-2.0
// The message type of a subscription's callback, and whether it takes messages as bytes.
#pragma once

#include <rmw/types.h>

#include <memory>
#include <type_traits>

#include "rclcpp/function_traits.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp::subscription_traits {

template <typename T>
struct is_serialized_subscription_argument : std::false_type {};
template <>
struct is_serialized_subscription_argument<SerializedMessage> : std::true_type {};
template <>
struct is_serialized_subscription_argument<std::shared_ptr<SerializedMessage>> : std::true_type {};

template <typename T>
struct is_serialized_subscription : is_serialized_subscription_argument<T> {};

template <typename CallbackT>
struct is_serialized_callback : is_serialized_subscription_argument<
                                    typename function_traits::function_traits<CallbackT>::template argument_type<0>> {};

// The message without references and pointers.
template <typename MessageT>
struct extract_message_type {
  using type = std::remove_cv_t<std::remove_reference_t<MessageT>>;
};
template <typename MessageT>
struct extract_message_type<std::shared_ptr<MessageT>> : extract_message_type<MessageT> {};
template <typename MessageT, typename DeleterT>
struct extract_message_type<std::unique_ptr<MessageT, DeleterT>> : extract_message_type<MessageT> {};

// That of the callback's first argument. Does not exist for what an overload of create_subscription() may be passed
// where another one takes the callback: a depth, a QoS, options.
template <typename CallbackT, typename AllocatorT = std::allocator<void>, typename PlainT = std::decay_t<CallbackT>,
          typename = std::enable_if_t<!std::is_integral_v<PlainT> && !std::is_base_of_v<QoS, PlainT> &&
                                      !std::is_same_v<rmw_qos_profile_t, PlainT> &&
                                      !std::is_same_v<SubscriptionOptionsWithAllocator<AllocatorT>, PlainT>>>
struct has_message_type
    : extract_message_type<typename function_traits::function_traits<CallbackT>::template argument_type<0>> {};

}  // namespace rclcpp::subscription_traits
