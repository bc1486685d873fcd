#include "com_interface.hpp"

#include <chrono>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>

namespace {

using lifecycle_msgs::msg::TransitionEvent;

struct NamedService {
  rcl_service_t rcl_lifecycle_com_interface_t::*service;
  const rosidl_service_type_support_t* ServiceTypeSupports::*type_support;
  const char* name;
};

constexpr NamedService kServices[] = {
    {&rcl_lifecycle_com_interface_t::srv_change_state, &ServiceTypeSupports::change_state, "~/change_state"},
    {&rcl_lifecycle_com_interface_t::srv_get_state, &ServiceTypeSupports::get_state, "~/get_state"},
    {&rcl_lifecycle_com_interface_t::srv_get_available_states, &ServiceTypeSupports::get_available_states,
     "~/get_available_states"},
    {&rcl_lifecycle_com_interface_t::srv_get_available_transitions, &ServiceTypeSupports::get_available_transitions,
     "~/get_available_transitions"},
    {&rcl_lifecycle_com_interface_t::srv_get_transition_graph, &ServiceTypeSupports::get_transition_graph,
     "~/get_transition_graph"},
};

rcl_ret_t init_entities(rcl_lifecycle_com_interface_t* com_interface, rcl_node_t* node_handle,
                        const ServiceTypeSupports& type_supports) {
  const rcl_publisher_options_t publisher_options = rcl_publisher_get_default_options();
  rcl_ret_t ret = rcl_publisher_init(&com_interface->pub_transition_event, node_handle,
                                     rosidl_typesupport_cpp::get_message_type_support_handle<TransitionEvent>(),
                                     "~/transition_event", &publisher_options);
  const rcl_service_options_t service_options = rcl_service_get_default_options();
  for (const NamedService& named : kServices) {
    if (ret != RCL_RET_OK) {
      break;
    }
    ret = rcl_service_init(&(com_interface->*named.service), node_handle, type_supports.*named.type_support, named.name,
                           &service_options);
  }
  return ret;
}

}  // namespace

rcl_ret_t com_interface_init(rcl_lifecycle_com_interface_t* com_interface, rcl_node_t* node_handle,
                             const ServiceTypeSupports& type_supports) {
  com_interface->node_handle = node_handle;
  const rcl_ret_t ret = init_entities(com_interface, node_handle, type_supports);
  if (ret != RCL_RET_OK) {
    (void)com_interface_fini(com_interface, node_handle);
  }
  return ret;
}

rcl_ret_t com_interface_fini(rcl_lifecycle_com_interface_t* com_interface, rcl_node_t* node_handle) {
  rcl_ret_t result = RCL_RET_OK;
  const auto keep_first_error = [&](rcl_ret_t ret) {
    if (result == RCL_RET_OK) {
      result = ret;
    }
  };
  for (const NamedService& named : kServices) {
    rcl_service_t& service = com_interface->*named.service;
    if (service.impl != nullptr) {
      keep_first_error(rcl_service_fini(&service, node_handle));
    }
  }
  if (com_interface->pub_transition_event.impl != nullptr) {
    keep_first_error(rcl_publisher_fini(&com_interface->pub_transition_event, node_handle));
  }
  *com_interface = {};
  return result;
}

rcl_ret_t publish_transition_event(const rcl_lifecycle_com_interface_t* com_interface,
                                   const rcl_lifecycle_transition_t& transition) {
  TransitionEvent event;
  event.timestamp = static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
  event.transition.id = static_cast<uint8_t>(transition.id);
  event.transition.label = transition.label;
  event.start_state.id = static_cast<uint8_t>(transition.start->id);
  event.start_state.label = transition.start->label;
  event.goal_state.id = static_cast<uint8_t>(transition.goal->id);
  event.goal_state.label = transition.goal->label;
  return rcl_publish(&com_interface->pub_transition_event, &event, nullptr);
}
