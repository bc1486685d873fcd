// SPDX-License-Identifier: Apache-2.0
// The network address from which a publisher sends, or at which a subscription receives.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RMW_INET_ADDRSTRLEN 48

typedef enum rmw_transport_protocol_e {
  RMW_TRANSPORT_PROTOCOL_UNKNOWN = 0,  // also for shared memory
  RMW_TRANSPORT_PROTOCOL_UDP,
  RMW_TRANSPORT_PROTOCOL_TCP
} rmw_transport_protocol_t;

typedef enum rmw_internet_protocol_e {
  RMW_INTERNET_PROTOCOL_UNKNOWN = 0,
  RMW_INTERNET_PROTOCOL_IPV4,
  RMW_INTERNET_PROTOCOL_IPV6
} rmw_internet_protocol_t;

typedef struct rmw_network_flow_endpoint_s {
  rmw_transport_protocol_t transport_protocol;
  rmw_internet_protocol_t internet_protocol;
  uint16_t transport_port;
  uint32_t flow_label;  // 0: not used
  uint8_t dscp;         // 0: not used
  char internet_address[RMW_INET_ADDRSTRLEN];
} rmw_network_flow_endpoint_t;

typedef struct rmw_network_flow_endpoint_array_s {
  size_t size;
  rmw_network_flow_endpoint_t* network_flow_endpoint;
  rcutils_allocator_t* allocator;
} rmw_network_flow_endpoint_array_t;

rmw_network_flow_endpoint_array_t rmw_get_zero_initialized_network_flow_endpoint_array(void);
rmw_ret_t rmw_network_flow_endpoint_array_fini(rmw_network_flow_endpoint_array_t* network_flow_endpoint_array);

#ifdef __cplusplus
}
#endif
