// SPDX-License-Identifier: Apache-2.0
// The clients and servers of a service, in the whole system.
#pragma once

#include "rmw/service_endpoint_info_array.h"

#ifdef __cplusplus
extern "C" {
#endif

// Takes the full name of the service. With `no_mangle`, types are those of DDS. `info` must be zero initialized.
// Discovery takes time: an end of which only one endpoint is known is left out, and of a node with several ends of one
// service the endpoints are told apart only when all are known.
rmw_ret_t rmw_get_clients_info_by_service(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          const char* service_name, bool no_mangle,
                                          rmw_service_endpoint_info_array_t* info);
rmw_ret_t rmw_get_servers_info_by_service(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          const char* service_name, bool no_mangle,
                                          rmw_service_endpoint_info_array_t* info);

#ifdef __cplusplus
}
#endif
