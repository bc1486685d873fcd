// SPDX-License-Identifier: Apache-2.0
// The options for creating a subscription besides topic, QoS and callback.
#pragma once

#include <rcl/subscription.h>
#include <rmw/types.h>

#include <chrono>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/event_handler.hpp"
#include "rclcpp/intra_process_buffer_type.hpp"
#include "rclcpp/intra_process_setting.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/qos_overriding_options.hpp"
#include "rclcpp/topic_statistics_state.hpp"

namespace rclcpp {

// Selects messages, in the filter language of DDS: `data > %0 AND header.frame_id = %1` with the parameters {"30",
// "'base'"}. Messages that do not match cause no wake-up. They are not even sent if the publisher knows the filter.
struct ContentFilterOptions {
  std::string filter_expression;  // empty: every message is wanted
  std::vector<std::string> expression_parameters;
};

struct SubscriptionOptionsBase {
  // Drops messages of publishers in the same context.
  bool ignore_local_publications = false;
  // Requirement on the subscription's network traffic. It is accepted, but the middleware has no such endpoints.
  rmw_unique_network_flow_endpoints_requirement_t require_unique_network_flow_endpoints =
      RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_NOT_REQUIRED;
  // Null: the node's default group.
  CallbackGroup::SharedPtr callback_group;
  // Whether events without a callback get the default one: it warns that an endpoint cannot match.
  bool use_default_callbacks = true;
  SubscriptionEventCallbacks event_callbacks;

  IntraProcessSetting use_intra_process_comm = IntraProcessSetting::NodeDefault;
  IntraProcessBufferType intra_process_buffer_type = IntraProcessBufferType::CallbackDefault;

  // Statistics of the received messages: their age and the time between them, as statistics_msgs/msg/MetricsMessage on
  // a topic of their own. Messages of intra-process communication have no age.
  struct TopicStatisticsOptions {
    TopicStatisticsState state = TopicStatisticsState::NodeDefault;
    std::string publish_topic = "/statistics";
    std::chrono::milliseconds publish_period{std::chrono::seconds(1)};
    QoS qos = SystemDefaultsQoS();
  };
  TopicStatisticsOptions topic_stats_options;

  QosOverridingOptions qos_overriding_options;
  ContentFilterOptions content_filter_options;
};

namespace detail {

rcl_subscription_options_t to_rcl_subscription_options(const SubscriptionOptionsBase& options, const QoS& qos);

}  // namespace detail

// AllocatorT, an allocator for void, allocates received messages.
template <typename AllocatorT>
struct SubscriptionOptionsWithAllocator : SubscriptionOptionsBase {
  static_assert(std::is_void_v<typename std::allocator_traits<AllocatorT>::value_type>,
                "Subscription allocator value type must be void");

  // Null: a default constructed allocator.
  std::shared_ptr<AllocatorT> allocator;

  SubscriptionOptionsWithAllocator() = default;
  explicit SubscriptionOptionsWithAllocator(const SubscriptionOptionsBase& options)
      : SubscriptionOptionsBase(options) {}

  std::shared_ptr<AllocatorT> get_allocator() const { return allocator ? allocator : std::make_shared<AllocatorT>(); }

  // These options for rcl; the caller finalizes them with rcl_subscription_options_fini(). Throws exceptions::RCLError.
  rcl_subscription_options_t to_rcl_subscription_options(const QoS& qos) const {
    return detail::to_rcl_subscription_options(*this, qos);
  }
};

using SubscriptionOptions = SubscriptionOptionsWithAllocator<std::allocator<void>>;

}  // namespace rclcpp
