// SPDX-License-Identifier: Apache-2.0
#include "rcl/client.h"

#include "node/node_entity.hpp"
#include "rmw/type_description.h"
#include "service/service_event_publisher.hpp"
#include "service_msgs/msg/service_event_info.hpp"
#include "tracetools/tracetools.h"

using service_msgs::msg::ServiceEventInfo;

struct rcl_client_impl_s {
  rcl_client_options_t options;
  rmw_qos_profile_t request_qos;
  rmw_qos_profile_t response_qos;
  rmw_client_t* rmw_handle;
  const rosidl_type_description_t* type;
  rcl::ServiceEventPublisher events{};
};

namespace {

void tell(const rcl_client_t& client, uint8_t event_type, int64_t sequence_number, const void* message) {
  if (client.impl->events.is_on()) {
    rmw_gid_t gid{};
    (void)rmw_get_gid_for_client(client.impl->rmw_handle, &gid);
    client.impl->events.publish(event_type, gid.data, sequence_number, message);
  }
}

}  // namespace

rcl_client_t rcl_get_zero_initialized_client(void) {
  return {};
}

rcl_client_options_t rcl_client_get_default_options(void) {
  return {rmw_qos_profile_services_default, rcl_get_default_allocator()};
}

rcl_ret_t rcl_client_init(rcl_client_t* client, const rcl_node_t* node,
                          const rosidl_service_type_support_t* type_support, const char* service_name,
                          const rcl_client_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(client, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  const auto create = [&](rmw_node_t* rmw_node, const char* name) {
    return rmw_create_client(rmw_node, type_support, name, &options->qos);
  };
  const auto complete = [&](rcl_client_impl_t& impl) {
    impl.type = rmw_service_type_description(type_support);
    rmw_ret_t result = rmw_client_request_publisher_get_actual_qos(impl.rmw_handle, &impl.request_qos);
    if (result == RMW_RET_OK) {
      result = rmw_client_response_subscription_get_actual_qos(impl.rmw_handle, &impl.response_qos);
    }
    impl.request_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    impl.response_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    return result;
  };
  if (const rcl_ret_t result = rcl::init_entity(client->impl, "client", node, rcl::NameKind::kService, service_name,
                                                *options, create, complete, rmw_destroy_client);
      result != RCL_RET_OK) {
    return result;
  }
  [[maybe_unused]] const auto* handle = client->impl->rmw_handle;
  TRACETOOLS_TRACEPOINT(rcl_client_init, static_cast<const void*>(client), static_cast<const void*>(node),
                        static_cast<const void*>(handle), handle->service_name);
  return RCL_RET_OK;
}

rcl_ret_t rcl_client_fini(rcl_client_t* client, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(client, RCL_RET_CLIENT_INVALID);
  return rcl::fini_entity(client->impl, node, [&](rmw_node_t* rmw_node, rcl_client_impl_t& impl) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_client_fini, static_cast<const void*>(client));
    const rcl_ret_t turned_off = impl.events.turn_off(node);
    const rmw_ret_t result = rmw_destroy_client(rmw_node, impl.rmw_handle);
    return result == RMW_RET_OK ? turned_off : result;
  });
}

rcl_ret_t rcl_send_request(const rcl_client_t* client, const void* ros_request, int64_t* sequence_number) {
  if (!rcl_client_is_valid(client)) {
    return RCL_RET_CLIENT_INVALID;
  }
  const rmw_ret_t result = rmw_send_request(client->impl->rmw_handle, ros_request, sequence_number);
  if (result == RMW_RET_OK) {
    tell(*client, ServiceEventInfo::REQUEST_SENT, *sequence_number, ros_request);
  }
  return result;
}

rcl_ret_t rcl_take_response_with_info(const rcl_client_t* client, rmw_service_info_t* request_header,
                                      void* ros_response) {
  if (!rcl_client_is_valid(client)) {
    return RCL_RET_CLIENT_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_response, RCL_RET_INVALID_ARGUMENT);
  bool taken = false;
  const rmw_ret_t result = rmw_take_response(client->impl->rmw_handle, request_header, ros_response, &taken);
  if (result != RMW_RET_OK) {
    return result;
  }
  if (!taken) {
    return RCL_RET_CLIENT_TAKE_FAILED;
  }
  tell(*client, ServiceEventInfo::RESPONSE_RECEIVED, request_header->request_id.sequence_number, ros_response);
  return RCL_RET_OK;
}

rcl_ret_t rcl_take_response(const rcl_client_t* client, rmw_request_id_t* request_header, void* ros_response) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RCL_RET_INVALID_ARGUMENT);
  rmw_service_info_t info{};
  info.request_id = *request_header;
  const rcl_ret_t result = rcl_take_response_with_info(client, &info, ros_response);
  *request_header = info.request_id;
  return result;
}

const char* rcl_client_get_service_name(const rcl_client_t* client) {
  return rcl_client_is_valid(client) ? client->impl->rmw_handle->service_name : nullptr;
}

const rcl_client_options_t* rcl_client_get_options(const rcl_client_t* client) {
  return rcl_client_is_valid(client) ? &client->impl->options : nullptr;
}

rmw_client_t* rcl_client_get_rmw_handle(const rcl_client_t* client) {
  return rcl_client_is_valid(client) ? client->impl->rmw_handle : nullptr;
}

const rmw_qos_profile_t* rcl_client_request_publisher_get_actual_qos(const rcl_client_t* client) {
  return rcl_client_is_valid(client) ? &client->impl->request_qos : nullptr;
}

const rmw_qos_profile_t* rcl_client_response_subscription_get_actual_qos(const rcl_client_t* client) {
  return rcl_client_is_valid(client) ? &client->impl->response_qos : nullptr;
}

bool rcl_client_is_valid(const rcl_client_t* client) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(client, "the client is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(client->impl, "the client is not initialized", return false);
  return true;
}

rcl_ret_t rcl_client_set_on_new_response_callback(const rcl_client_t* client, rcl_event_callback_t callback,
                                                  const void* user_data) {
  if (!rcl_client_is_valid(client)) {
    return RCL_RET_CLIENT_INVALID;
  }
  return rmw_client_set_on_new_response_callback(client->impl->rmw_handle, callback, user_data);
}

rcl_ret_t rcl_client_configure_service_introspection(rcl_client_t* client, rcl_node_t* node, rcl_clock_t* clock,
                                                     const rosidl_service_type_support_t* type_support,
                                                     const rcl_publisher_options_t publisher_options,
                                                     rcl_service_introspection_state_t introspection_state) {
  if (!rcl_client_is_valid(client)) {
    return RCL_RET_CLIENT_INVALID;
  }
  return client->impl->events.configure(node, clock, type_support, rcl_client_get_service_name(client),
                                        publisher_options, introspection_state);
}
