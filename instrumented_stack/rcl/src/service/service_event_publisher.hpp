// SPDX-License-Identifier: Apache-2.0
// What an end of a service publishes of its calls while its introspection is on.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

namespace rcl {

// Thread safe. Must be off when it is destroyed.
class ServiceEventPublisher {
 public:
  // Turns it on with a publisher on the topic beside `service_name`, or off, or changes what is told. The options count
  // when it is turned on; the clock, which must live as long as it is on, at every call. RCL_RET_INVALID_ARGUMENT, and
  // what rcl_publisher_init() returns; it is then as before.
  rcl_ret_t configure(rcl_node_t* node, rcl_clock_t* clock, const rosidl_service_type_support_t* type_support,
                      const char* service_name, const rcl_publisher_options_t& options,
                      rcl_service_introspection_state_t state);

  // No event is published any more when this returns.
  rcl_ret_t turn_off(rcl_node_t* node);

  // All that a call costs while it is off.
  bool is_on() const { return on_.load(std::memory_order_acquire); }

  // Publishes an event of one of the types of service_msgs/msg/ServiceEventInfo; `message` is the request or the
  // response of the call, as the type says. If that fails it is logged: the call itself goes on.
  void publish(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number, const void* message);

 private:
  rcl_ret_t turn_on(const rcl_node_t* node, const rosidl_service_type_support_t* type_support, const char* service_name,
                    const rcl_publisher_options_t& options);
  rcl_ret_t publish_event(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number, const void* message);

  std::atomic<bool> on_{false};  // changed under the mutex
  std::mutex mutex_;             // of everything below
  rcl_service_introspection_state_t state_ = RCL_SERVICE_INTROSPECTION_OFF;
  rcl_clock_t* clock_ = nullptr;
  const rosidl_service_type_support_t* type_support_ = nullptr;
  rcl_publisher_t publisher_ = rcl_get_zero_initialized_publisher();
};

}  // namespace rcl
