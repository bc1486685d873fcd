// SPDX-License-Identifier: Apache-2.0
// The options for creating a publisher besides topic and QoS.
#pragma once

#include <rcl/publisher.h>
#include <rmw/types.h>

#include <memory>
#include <type_traits>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/event_handler.hpp"
#include "rclcpp/intra_process_setting.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/qos_overriding_options.hpp"

namespace rclcpp {

struct PublisherOptionsBase {
  IntraProcessSetting use_intra_process_comm = IntraProcessSetting::NodeDefault;
  // Requirement on the publisher's network traffic. It is accepted, but the middleware has no such endpoints.
  rmw_unique_network_flow_endpoints_requirement_t require_unique_network_flow_endpoints =
      RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_NOT_REQUIRED;
  // Whether events without a callback get the default one: it warns that an endpoint cannot match.
  bool use_default_callbacks = true;
  PublisherEventCallbacks event_callbacks;
  // The group of the event callbacks. Null: the node's default group.
  CallbackGroup::SharedPtr callback_group;
  QosOverridingOptions qos_overriding_options;
};

// AllocatorT, an allocator for void, allocates messages that the publisher creates.
template <typename AllocatorT>
struct PublisherOptionsWithAllocator : PublisherOptionsBase {
  static_assert(std::is_void_v<typename std::allocator_traits<AllocatorT>::value_type>,
                "Publisher allocator value type must be void");

  // Null: a default constructed allocator.
  std::shared_ptr<AllocatorT> allocator;

  PublisherOptionsWithAllocator() = default;
  explicit PublisherOptionsWithAllocator(const PublisherOptionsBase& options) : PublisherOptionsBase(options) {}

  std::shared_ptr<AllocatorT> get_allocator() const { return allocator ? allocator : std::make_shared<AllocatorT>(); }

  // These options for rcl. `MessageT` is only named, as in rclcpp.
  template <typename MessageT>
  rcl_publisher_options_t to_rcl_publisher_options(const QoS& qos) const {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    options.qos = qos.get_rmw_qos_profile();
    options.rmw_publisher_options.require_unique_network_flow_endpoints = require_unique_network_flow_endpoints;
    return options;
  }
};

using PublisherOptions = PublisherOptionsWithAllocator<std::allocator<void>>;

}  // namespace rclcpp
