// SPDX-License-Identifier: Apache-2.0
#include "com_interface.hpp"

#include <lifecycle_msgs/msg/transition_event.h>

#include <chrono>
#include <cstring>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <string>

#include "rcl/error_handling.h"

namespace rcl_lifecycle {

namespace {

struct NamedService {
  const char* name;
  rcl_service_t rcl_lifecycle_com_interface_t::*service;
};

constexpr std::array<NamedService, 5> kServices = {
    {{"~/change_state", &rcl_lifecycle_com_interface_t::srv_change_state},
     {"~/get_state", &rcl_lifecycle_com_interface_t::srv_get_state},
     {"~/get_available_states", &rcl_lifecycle_com_interface_t::srv_get_available_states},
     {"~/get_available_transitions", &rcl_lifecycle_com_interface_t::srv_get_available_transitions},
     {"~/get_transition_graph", &rcl_lifecycle_com_interface_t::srv_get_transition_graph}}};

rcl_ret_t init_all(rcl_lifecycle_com_interface_t& com, rcl_node_t* node,
                   const rosidl_message_type_support_t* event_type, const ServiceTypes& service_types) {
  com.node_handle = node;
  com.has_messages_of_c = get_message_typesupport_handle(event_type, "rosidl_typesupport_c") != nullptr;
  const rcl_publisher_options_t publisher_options = rcl_publisher_get_default_options();
  rcl_ret_t ret =
      rcl_publisher_init(&com.pub_transition_event, node, event_type, "~/transition_event", &publisher_options);
  const rcl_service_options_t service_options = rcl_service_get_default_options();
  for (std::size_t i = 0; i < kServices.size() && ret == RCL_RET_OK; ++i) {
    ret = rcl_service_init(&(com.*kServices[i].service), node, service_types[i], kServices[i].name, &service_options);
  }
  return ret;
}

uint64_t now() {
  return static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
}

void set(std::string& target, const char* label) {
  target = label;
}

// The message borrows the label.
void set(rosidl_runtime_c__String& target, const char* label) {
  const size_t size = std::strlen(label);
  target = {const_cast<char*>(label), size, size + 1};
}

template <typename EventT>
rcl_ret_t publish_event(const rcl_publisher_t& publisher, const rcl_lifecycle_transition_t& transition) {
  EventT event{};
  event.timestamp = now();
  event.transition.id = static_cast<uint8_t>(transition.id);
  set(event.transition.label, transition.label);
  event.start_state.id = static_cast<uint8_t>(transition.start->id);
  set(event.start_state.label, transition.start->label);
  event.goal_state.id = static_cast<uint8_t>(transition.goal->id);
  set(event.goal_state.label, transition.goal->label);
  return rcl_publish(&publisher, &event, nullptr);
}

}  // namespace

rcl_ret_t init(rcl_lifecycle_com_interface_t& com, rcl_node_t* node, const rosidl_message_type_support_t* event_type,
               const ServiceTypes& service_types) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(event_type, RCL_RET_INVALID_ARGUMENT);
  for (const rosidl_service_type_support_t* type : service_types) {
    RCUTILS_CHECK_FOR_NULL_WITH_MSG(type, "a type support of a service is null", return RCL_RET_INVALID_ARGUMENT);
  }
  const rcl_ret_t ret = init_all(com, node, event_type, service_types);
  if (ret != RCL_RET_OK) {
    const rcl_error_string_t reason = rcl_get_error_string();
    (void)fini(com, node);
    rcl_reset_error();
    RCL_SET_ERROR_MSG(reason.str);
  }
  return ret;
}

rcl_ret_t fini(rcl_lifecycle_com_interface_t& com, rcl_node_t* node) {
  rcl_ret_t first_error = RCL_RET_OK;
  const auto note = [&](rcl_ret_t ret) { first_error = first_error == RCL_RET_OK ? ret : first_error; };
  for (const NamedService& each : kServices) {
    if ((com.*each.service).impl != nullptr) {
      note(rcl_service_fini(&(com.*each.service), node));
    }
  }
  if (com.pub_transition_event.impl != nullptr) {
    note(rcl_publisher_fini(&com.pub_transition_event, node));
  }
  com = {};
  return first_error;
}

rcl_ret_t publish(const rcl_lifecycle_com_interface_t& com, const rcl_lifecycle_transition_t& transition) {
  return com.has_messages_of_c
             ? publish_event<lifecycle_msgs__msg__TransitionEvent>(com.pub_transition_event, transition)
             : publish_event<lifecycle_msgs::msg::TransitionEvent>(com.pub_transition_event, transition);
}

}  // namespace rcl_lifecycle
