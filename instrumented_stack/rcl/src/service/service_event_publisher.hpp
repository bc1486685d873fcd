// SPDX-License-Identifier: Apache-2.0
// Publishes the calls of one end of a service while its introspection is on.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rosidl_runtime_c/service_type_support_struct.h"

namespace rcl {

// Thread safe. Turn it off before destroying it.
class ServiceEventPublisher {
 public:
  // Turns introspection on, with a publisher on the topic beside `service_name`, or off, or changes the content of the
  // events. The options only apply when it is turned on. The clock applies at every call and must live as long as
  // introspection is on. Returns RCL_RET_INVALID_ARGUMENT or an error of rcl_publisher_init(); nothing has changed
  // then.
  rcl_ret_t configure(rcl_node_t* node, rcl_clock_t* clock, const rosidl_service_type_support_t* type_support,
                      const char* service_name, const rcl_publisher_options_t& options,
                      rcl_service_introspection_state_t state);

  // No event is published after this returns.
  rcl_ret_t turn_off(rcl_node_t* node);

  // The only cost of a call while introspection is off.
  bool is_on() const { return on_.load(std::memory_order_acquire); }

  // Publishes an event of one of the types of service_msgs/msg/ServiceEventInfo. `message` is the request or the
  // response of the call, depending on the type. A failure is logged and does not affect the call.
  void publish(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number, const void* message);

 private:
  rcl_ret_t turn_on(const rcl_node_t* node, const rosidl_service_type_support_t* type_support, const char* service_name,
                    const rcl_publisher_options_t& options);
  rcl_ret_t publish_event(uint8_t event_type, const uint8_t* client_gid, int64_t sequence_number, const void* message);

  std::atomic<bool> on_{false};  // modified only with the mutex held
  std::mutex mutex_;             // guards everything below
  rcl_service_introspection_state_t state_ = RCL_SERVICE_INTROSPECTION_OFF;
  rcl_clock_t* clock_ = nullptr;
  const rosidl_service_type_support_t* type_support_ = nullptr;
  rcl_publisher_t publisher_ = rcl_get_zero_initialized_publisher();
};

}  // namespace rcl
