// SPDX-License-Identifier: Apache-2.0
// The addresses that a publisher may send from, or a subscription receives at.
#pragma once

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/context.h"
#include "rcl/macros.h"
#include "rcl/publisher.h"
#include "rcl/subscription.h"
#include "rcl/types.h"
#include "rmw/network_flow_endpoint.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rmw_network_flow_endpoint_t rcl_network_flow_endpoint_t;
typedef rmw_network_flow_endpoint_array_t rcl_network_flow_endpoint_array_t;
typedef rmw_transport_protocol_t rcl_transport_protocol_t;
typedef rmw_internet_protocol_t rcl_internet_protocol_t;

#define rcl_get_zero_initialized_network_flow_endpoint_array rmw_get_zero_initialized_network_flow_endpoint_array
#define rcl_network_flow_endpoint_array_fini rmw_network_flow_endpoint_array_fini

// Pass a zero initialised array, and finalize it with rcl_network_flow_endpoint_array_fini(). Return
// RCL_RET_PUBLISHER_INVALID or RCL_RET_SUBSCRIPTION_INVALID, or RCL_RET_INVALID_ARGUMENT for null.
rcl_ret_t rcl_publisher_get_network_flow_endpoints(const rcl_publisher_t* publisher, rcutils_allocator_t* allocator,
                                                   rcl_network_flow_endpoint_array_t* network_flow_endpoint_array);
rcl_ret_t rcl_subscription_get_network_flow_endpoints(const rcl_subscription_t* subscription,
                                                      rcutils_allocator_t* allocator,
                                                      rcl_network_flow_endpoint_array_t* network_flow_endpoint_array);

#ifdef __cplusplus
}
#endif
