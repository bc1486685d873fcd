// SPDX-License-Identifier: Apache-2.0
#include "rcl/publisher.h"

#include <string>

#include "node/node_entity.hpp"
#include "rcl/network_flow_endpoints.h"
#include "rmw/type_description.h"
#include "tracetools/tracetools.h"

struct rcl_publisher_impl_s {
  // Everything that each message needs is in one cache line.
  rcl_context_t* context;
  rmw_publisher_t* rmw_handle;

  rcl_publisher_options_t options;
  rmw_qos_profile_t actual_qos;
  const rosidl_type_description_t* type;
};

rcl_publisher_t rcl_get_zero_initialized_publisher(void) {
  return {};
}

rcl_publisher_options_t rcl_publisher_get_default_options(void) {
  return {rmw_qos_profile_default, rcl_get_default_allocator(), rmw_get_default_publisher_options()};
}

rcl_ret_t rcl_publisher_init(rcl_publisher_t* publisher, const rcl_node_t* node,
                             const rosidl_message_type_support_t* type_support, const char* topic_name,
                             const rcl_publisher_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(publisher, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  const auto create = [&](rmw_node_t* rmw_node, const char* name) {
    return rmw_create_publisher(rmw_node, type_support, name, &options->qos, &options->rmw_publisher_options);
  };
  const auto complete = [&](rcl_publisher_impl_t& impl) {
    impl.type = rmw_message_type_description(type_support);
    const rmw_ret_t result = rmw_publisher_get_actual_qos(impl.rmw_handle, &impl.actual_qos);
    impl.actual_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    return result;
  };
  if (const rcl_ret_t result = rcl::init_entity(publisher->impl, "publisher", node, rcl::NameKind::kTopic, topic_name,
                                                *options, create, complete, rmw_destroy_publisher);
      result != RCL_RET_OK) {
    return result;
  }
  publisher->impl->context = node->context;
  [[maybe_unused]] const auto* handle = publisher->impl->rmw_handle;
  TRACETOOLS_TRACEPOINT(rcl_publisher_init, static_cast<const void*>(publisher), static_cast<const void*>(node),
                        static_cast<const void*>(handle), handle->topic_name, options->qos.depth);
  return RCL_RET_OK;
}

rcl_ret_t rcl_publisher_fini(rcl_publisher_t* publisher, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(publisher, RCL_RET_PUBLISHER_INVALID);
  return rcl::fini_entity(publisher->impl, node, [&](rmw_node_t* rmw_node, rcl_publisher_impl_t& impl) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_publisher_fini, static_cast<const void*>(publisher));
    return rmw_destroy_publisher(rmw_node, impl.rmw_handle);
  });
}

[[gnu::hot]] rcl_ret_t rcl_publish(const rcl_publisher_t* publisher, const void* ros_message,
                                   rmw_publisher_allocation_t* allocation) {
  if (!rcl_publisher_is_valid(publisher)) {
    return RCL_RET_PUBLISHER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RCL_RET_INVALID_ARGUMENT);
  TRACETOOLS_TRACEPOINT(rcl_publish, static_cast<const void*>(publisher), ros_message);
  return rmw_publish(publisher->impl->rmw_handle, ros_message, allocation);
}

rcl_ret_t rcl_publish_serialized_message(const rcl_publisher_t* publisher,
                                         const rcl_serialized_message_t* serialized_message,
                                         rmw_publisher_allocation_t* allocation) {
  if (!rcl_publisher_is_valid(publisher)) {
    return RCL_RET_PUBLISHER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(serialized_message, RCL_RET_INVALID_ARGUMENT);
  TRACETOOLS_TRACEPOINT(rcl_publish, static_cast<const void*>(publisher), static_cast<const void*>(serialized_message));
  return rmw_publish_serialized_message(publisher->impl->rmw_handle, serialized_message, allocation);
}

rcl_ret_t rcl_borrow_loaned_message(const rcl_publisher_t* publisher, const rosidl_message_type_support_t* type_support,
                                    void** ros_message) {
  return rcl_publisher_is_valid(publisher)
             ? rmw_borrow_loaned_message(publisher->impl->rmw_handle, type_support, ros_message)
             : RCL_RET_PUBLISHER_INVALID;
}

rcl_ret_t rcl_return_loaned_message_from_publisher(const rcl_publisher_t* publisher, void* loaned_message) {
  // Allowed after shutdown, too: a borrowed message must be returned.
  return rcl_publisher_is_valid_except_context(publisher)
             ? rmw_return_loaned_message_from_publisher(publisher->impl->rmw_handle, loaned_message)
             : RCL_RET_PUBLISHER_INVALID;
}

rcl_ret_t rcl_publish_loaned_message(const rcl_publisher_t* publisher, void* ros_message,
                                     rmw_publisher_allocation_t* allocation) {
  if (!rcl_publisher_is_valid(publisher)) {
    return RCL_RET_PUBLISHER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_message, RCL_RET_INVALID_ARGUMENT);
  TRACETOOLS_TRACEPOINT(rcl_publish, static_cast<const void*>(publisher), static_cast<const void*>(ros_message));
  return rmw_publish_loaned_message(publisher->impl->rmw_handle, ros_message, allocation);
}

rcl_ret_t rcl_publisher_assert_liveliness(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid(publisher) ? rmw_publisher_assert_liveliness(publisher->impl->rmw_handle)
                                           : RCL_RET_PUBLISHER_INVALID;
}

rcl_ret_t rcl_publisher_wait_for_all_acked(const rcl_publisher_t* publisher, rmw_duration_t timeout) {
  return rcl_publisher_is_valid(publisher)
             ? rmw_publisher_wait_for_all_acked(publisher->impl->rmw_handle, rmw_time_from_nsec(timeout))
             : RCL_RET_PUBLISHER_INVALID;
}

const char* rcl_publisher_get_topic_name(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) ? publisher->impl->rmw_handle->topic_name : nullptr;
}

const rcl_publisher_options_t* rcl_publisher_get_options(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) ? &publisher->impl->options : nullptr;
}

rmw_publisher_t* rcl_publisher_get_rmw_handle(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) ? publisher->impl->rmw_handle : nullptr;
}

rcl_context_t* rcl_publisher_get_context(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) ? publisher->impl->context : nullptr;
}

const rmw_qos_profile_t* rcl_publisher_get_actual_qos(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) ? &publisher->impl->actual_qos : nullptr;
}

rcl_ret_t rcl_publisher_get_subscription_count(const rcl_publisher_t* publisher, size_t* subscription_count) {
  return rcl_publisher_is_valid(publisher)
             ? rmw_publisher_count_matched_subscriptions(publisher->impl->rmw_handle, subscription_count)
             : RCL_RET_PUBLISHER_INVALID;
}

[[gnu::hot]] bool rcl_publisher_is_valid_except_context(const rcl_publisher_t* publisher) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(publisher, "the publisher is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(publisher->impl, "the publisher is not initialized", return false);
  return true;
}

[[gnu::hot]] bool rcl_publisher_is_valid(const rcl_publisher_t* publisher) {
  if (!rcl_publisher_is_valid_except_context(publisher)) {
    return false;
  }
  if (!rcl_context_is_valid(publisher->impl->context)) {
    RCL_SET_ERROR_MSG("the context of the publisher is shut down");
    return false;
  }
  return true;
}

bool rcl_publisher_can_loan_messages(const rcl_publisher_t* publisher) {
  return rcl_publisher_is_valid_except_context(publisher) && publisher->impl->rmw_handle->can_loan_messages;
}

rcl_ret_t rcl_publisher_get_network_flow_endpoints(const rcl_publisher_t* publisher, rcutils_allocator_t* allocator,
                                                   rcl_network_flow_endpoint_array_t* network_flow_endpoint_array) {
  return rcl_publisher_is_valid(publisher) ? rmw_publisher_get_network_flow_endpoints(
                                                 publisher->impl->rmw_handle, allocator, network_flow_endpoint_array)
                                           : RCL_RET_PUBLISHER_INVALID;
}
