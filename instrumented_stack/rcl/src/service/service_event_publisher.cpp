// SPDX-License-Identifier: Apache-2.0
#include "service/service_event_publisher.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "rcl/error_handling.h"
#include "rcutils/logging_macros.h"
#include "service_msgs/msg/service_event_info.hpp"

namespace rcl {

using service_msgs::msg::ServiceEventInfo;

rcl_ret_t ServiceEventPublisher::configure(rcl_node_t* node, rcl_clock_t* clock,
                                           const rosidl_service_type_support_t* type_support, const char* service_name,
                                           const rcl_publisher_options_t& options,
                                           rcl_service_introspection_state_t state) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  if (state == RCL_SERVICE_INTROSPECTION_OFF) {
    return turn_off(node);
  }
  if (state != RCL_SERVICE_INTROSPECTION_METADATA && state != RCL_SERVICE_INTROSPECTION_CONTENTS) {
    RCL_SET_ERROR_MSG("there is no such state of service introspection");
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (!rcl_clock_valid(clock)) {
    RCL_SET_ERROR_MSG("the clock is not initialized");
    return RCL_RET_INVALID_ARGUMENT;
  }
  const std::lock_guard lock(mutex_);
  if (!is_on()) {
    if (const rcl_ret_t result = turn_on(node, type_support, service_name, options); result != RCL_RET_OK) {
      return result;
    }
  }
  state_ = state;
  clock_ = clock;
  on_.store(true, std::memory_order_release);
  return RCL_RET_OK;
}

rcl_ret_t ServiceEventPublisher::turn_on(const rcl_node_t* node, const rosidl_service_type_support_t* type_support,
                                         const char* service_name, const rcl_publisher_options_t& options) {
  if (type_support->event_typesupport == nullptr) {
    RCL_SET_ERROR_MSG("the type support of the service has no event message");
    return RCL_RET_INVALID_ARGUMENT;
  }
  const std::string topic = std::string(service_name) + RCL_SERVICE_INTROSPECTION_TOPIC_POSTFIX;
  type_support_ = type_support;
  return rcl_publisher_init(&publisher_, node, type_support->event_typesupport, topic.c_str(), &options);
}

rcl_ret_t ServiceEventPublisher::turn_off(rcl_node_t* node) {
  const std::lock_guard lock(mutex_);
  const rcl_ret_t result = rcl_publisher_fini(&publisher_, node);
  on_.store(publisher_.impl != nullptr, std::memory_order_release);
  return result;
}

void ServiceEventPublisher::publish(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number,
                                    const void* message) {
  const std::lock_guard lock(mutex_);
  // Introspection may have been turned off since the caller checked. After the end of the context no event is
  // published.
  if (!is_on() || !rcl_context_is_valid(rcl_publisher_get_context(&publisher_))) {
    return;
  }
  if (publish_event(event_type, client_gid, sequence_number, message) != RCL_RET_OK) {
    RCUTILS_LOG_WARN_NAMED("rcl", "failed to publish an event on '%s': %s", rcl_publisher_get_topic_name(&publisher_),
                           rcl_get_error_string().str);
    rcl_reset_error();
  }
}

rcl_ret_t ServiceEventPublisher::publish_event(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number,
                                               const void* message) {
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(clock_, &now); result != RCL_RET_OK) {
    return result;
  }
  rosidl_service_introspection_info_t info{};
  info.event_type = event_type;
  info.stamp_sec = static_cast<int32_t>(RCL_NS_TO_S(now));
  info.stamp_nanosec = static_cast<uint32_t>(now % RCL_S_TO_NS(1));
  std::copy_n(client_gid, std::size(info.client_gid), info.client_gid);
  info.sequence_number = sequence_number;

  const bool is_request =
      event_type == ServiceEventInfo::REQUEST_SENT || event_type == ServiceEventInfo::REQUEST_RECEIVED;
  const void* contents = state_ == RCL_SERVICE_INTROSPECTION_CONTENTS ? message : nullptr;
  void* event = type_support_->event_message_create_handle_function(&info, is_request ? contents : nullptr,
                                                                    is_request ? nullptr : contents);
  if (event == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for the event of a service");
    return RCL_RET_BAD_ALLOC;
  }
  const rcl_ret_t result = rcl_publish(&publisher_, event, nullptr);
  type_support_->event_message_destroy_handle_function(event);
  return result;
}

}  // namespace rcl
