// SPDX-License-Identifier: Apache-2.0
// A node: a name in the graph that owns publishers and subscriptions.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rcl/context.h"
#include "rcl/guard_condition.h"
#include "rcl/node_options.h"
#include "rcl/types.h"
#include "type_description_interfaces/srv/get_type_description.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_node_impl_s rcl_node_impl_t;
typedef struct rcl_service_s rcl_service_t;

typedef struct rcl_node_s {
  rcl_context_t* context;
  rcl_node_impl_t* impl;
} rcl_node_t;

rcl_node_t rcl_get_zero_initialized_node(void);

// Creates the node. Name and namespace are remapped, and a relative namespace gets a leading slash. Fires
// rcl_node_init, then creates the publisher on /rosout if `options` and the process arguments enable it. Returns
// RCL_RET_NODE_INVALID_NAME, RCL_RET_NODE_INVALID_NAMESPACE, RCL_RET_NOT_INIT or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_node_init(rcl_node_t* node, const char* name, const char* namespace_, rcl_context_t* context,
                        const rcl_node_options_t* options);

// Also removes the node's /rosout publisher. Publishers and subscriptions must be destroyed before.
rcl_ret_t rcl_node_fini(rcl_node_t* node);

bool rcl_node_is_valid(const rcl_node_t* node);
bool rcl_node_is_valid_except_context(const rcl_node_t* node);
const char* rcl_node_get_name(const rcl_node_t* node);
const char* rcl_node_get_namespace(const rcl_node_t* node);
const char* rcl_node_get_fully_qualified_name(const rcl_node_t* node);
const rcl_node_options_t* rcl_node_get_options(const rcl_node_t* node);
rcl_ret_t rcl_node_get_domain_id(const rcl_node_t* node, size_t* domain_id);
rmw_node_t* rcl_node_get_rmw_handle(const rcl_node_t* node);
uint64_t rcl_node_get_rcl_instance_id(const rcl_node_t* node);
const rcl_guard_condition_t* rcl_node_get_graph_guard_condition(const rcl_node_t* node);

// `ns.node`, without the leading slash.
const char* rcl_node_get_logger_name(const rcl_node_t* node);

// Expands and remaps a topic or service name, as publishers and services of this node do. `only_expand` skips the
// remapping. Free the output with `allocator`.
rcl_ret_t rcl_node_resolve_name(const rcl_node_t* node, const char* input_name, rcl_allocator_t allocator,
                                bool is_service, bool only_expand, char** output_name);

// Creates the service ~/get_type_description, with messages of C. The caller answers its requests and finalizes it.
rcl_ret_t rcl_node_type_description_service_init(rcl_service_t* service, const rcl_node_t* node);

// Makes the answer to a request of that service. What `response` contained before is overwritten, not freed; the caller
// finalizes it. Any thread.
void rcl_node_type_description_service_handle_request(
    rcl_node_t* node, const rmw_request_id_t* request_header,
    const type_description_interfaces__srv__GetTypeDescription_Request* request,
    type_description_interfaces__srv__GetTypeDescription_Response* response);

#ifdef __cplusplus
}
#endif
