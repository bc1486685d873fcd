// SPDX-License-Identifier: Apache-2.0
#include "rcl/service.h"

#include "node/node_entity.hpp"
#include "rmw/type_description.h"
#include "service/service_event_publisher.hpp"
#include "service_msgs/msg/service_event_info.hpp"
#include "tracetools/tracetools.h"

using service_msgs::msg::ServiceEventInfo;

struct rcl_service_impl_s {
  rcl_service_options_t options;
  rmw_qos_profile_t request_qos;
  rmw_qos_profile_t response_qos;
  rmw_service_t* rmw_handle;
  const rosidl_type_description_t* type;
  rcl::ServiceEventPublisher events{};
};

namespace {

void tell(const rcl_service_t& service, uint8_t event_type, const rmw_request_id_t& id, const void* message) {
  if (service.impl->events.is_on()) {
    service.impl->events.publish(event_type, reinterpret_cast<const uint8_t*>(id.writer_guid), id.sequence_number,
                                 message);
  }
}

}  // namespace

rcl_service_t rcl_get_zero_initialized_service(void) {
  return {};
}

rcl_service_options_t rcl_service_get_default_options(void) {
  return {rmw_qos_profile_services_default, rcl_get_default_allocator()};
}

rcl_ret_t rcl_service_init(rcl_service_t* service, const rcl_node_t* node,
                           const rosidl_service_type_support_t* type_support, const char* service_name,
                           const rcl_service_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_support, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  const auto create = [&](rmw_node_t* rmw_node, const char* name) {
    return rmw_create_service(rmw_node, type_support, name, &options->qos);
  };
  const auto complete = [&](rcl_service_impl_t& impl) {
    impl.type = rmw_service_type_description(type_support);
    rmw_ret_t result = rmw_service_request_subscription_get_actual_qos(impl.rmw_handle, &impl.request_qos);
    if (result == RMW_RET_OK) {
      result = rmw_service_response_publisher_get_actual_qos(impl.rmw_handle, &impl.response_qos);
    }
    impl.request_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    impl.response_qos.avoid_ros_namespace_conventions = options->qos.avoid_ros_namespace_conventions;
    return result;
  };
  if (const rcl_ret_t result = rcl::init_entity(service->impl, "service", node, rcl::NameKind::kService, service_name,
                                                *options, create, complete, rmw_destroy_service);
      result != RCL_RET_OK) {
    return result;
  }
  [[maybe_unused]] const auto* handle = service->impl->rmw_handle;
  TRACETOOLS_TRACEPOINT(rcl_service_init, static_cast<const void*>(service), static_cast<const void*>(node),
                        static_cast<const void*>(handle), handle->service_name);
  return RCL_RET_OK;
}

rcl_ret_t rcl_service_fini(rcl_service_t* service, rcl_node_t* node) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service, RCL_RET_SERVICE_INVALID);
  return rcl::fini_entity(service->impl, node, [&](rmw_node_t* rmw_node, rcl_service_impl_t& impl) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_service_fini, static_cast<const void*>(service));
    const rcl_ret_t turned_off = impl.events.turn_off(node);
    const rmw_ret_t result = rmw_destroy_service(rmw_node, impl.rmw_handle);
    return result == RMW_RET_OK ? turned_off : result;
  });
}

rcl_ret_t rcl_take_request_with_info(const rcl_service_t* service, rmw_service_info_t* request_header,
                                     void* ros_request) {
  if (!rcl_service_is_valid(service)) {
    return RCL_RET_SERVICE_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(ros_request, RCL_RET_INVALID_ARGUMENT);
  bool taken = false;
  const rmw_ret_t result = rmw_take_request(service->impl->rmw_handle, request_header, ros_request, &taken);
  if (result != RMW_RET_OK) {
    return result;
  }
  if (!taken) {
    return RCL_RET_SERVICE_TAKE_FAILED;
  }
  tell(*service, ServiceEventInfo::REQUEST_RECEIVED, request_header->request_id, ros_request);
  return RCL_RET_OK;
}

rcl_ret_t rcl_take_request(const rcl_service_t* service, rmw_request_id_t* request_header, void* ros_request) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request_header, RCL_RET_INVALID_ARGUMENT);
  rmw_service_info_t info{};
  info.request_id = *request_header;
  const rcl_ret_t result = rcl_take_request_with_info(service, &info, ros_request);
  *request_header = info.request_id;
  return result;
}

rcl_ret_t rcl_send_response(const rcl_service_t* service, rmw_request_id_t* response_header, void* ros_response) {
  if (!rcl_service_is_valid(service)) {
    return RCL_RET_SERVICE_INVALID;
  }
  const rmw_ret_t result = rmw_send_response(service->impl->rmw_handle, response_header, ros_response);
  if (result == RMW_RET_OK) {
    tell(*service, ServiceEventInfo::RESPONSE_SENT, *response_header, ros_response);
  }
  return result;
}

const char* rcl_service_get_service_name(const rcl_service_t* service) {
  return rcl_service_is_valid(service) ? service->impl->rmw_handle->service_name : nullptr;
}

const rcl_service_options_t* rcl_service_get_options(const rcl_service_t* service) {
  return rcl_service_is_valid(service) ? &service->impl->options : nullptr;
}

rmw_service_t* rcl_service_get_rmw_handle(const rcl_service_t* service) {
  return rcl_service_is_valid(service) ? service->impl->rmw_handle : nullptr;
}

const rmw_qos_profile_t* rcl_service_request_subscription_get_actual_qos(const rcl_service_t* service) {
  return rcl_service_is_valid(service) ? &service->impl->request_qos : nullptr;
}

const rmw_qos_profile_t* rcl_service_response_publisher_get_actual_qos(const rcl_service_t* service) {
  return rcl_service_is_valid(service) ? &service->impl->response_qos : nullptr;
}

bool rcl_service_is_valid(const rcl_service_t* service) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(service, "the service is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(service->impl, "the service is not initialized", return false);
  return true;
}

rcl_ret_t rcl_service_set_on_new_request_callback(const rcl_service_t* service, rcl_event_callback_t callback,
                                                  const void* user_data) {
  if (!rcl_service_is_valid(service)) {
    return RCL_RET_SERVICE_INVALID;
  }
  return rmw_service_set_on_new_request_callback(service->impl->rmw_handle, callback, user_data);
}

rcl_ret_t rcl_service_configure_service_introspection(rcl_service_t* service, rcl_node_t* node, rcl_clock_t* clock,
                                                      const rosidl_service_type_support_t* type_support,
                                                      const rcl_publisher_options_t publisher_options,
                                                      rcl_service_introspection_state_t introspection_state) {
  if (!rcl_service_is_valid(service)) {
    return RCL_RET_SERVICE_INVALID;
  }
  return service->impl->events.configure(node, clock, type_support, rcl_service_get_service_name(service),
                                         publisher_options, introspection_state);
}
