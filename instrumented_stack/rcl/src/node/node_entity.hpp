// SPDX-License-Identifier: Apache-2.0
// How publishers, subscriptions, clients and services begin and end. rmw makes each of them in a node, under a name
// that rcl resolves, and the node knows their types.
#pragma once

#include <memory>
#include <utility>

#include "rcl/error_handling.h"
#include "rcl/node.h"
#include "rcl/node_type_cache.h"
#include "rmw/rmw.h"

namespace rcl {

enum class NameKind { kTopic, kService };

// Gives `place` an entity with these options. `create` makes the handle of rmw in a node and under a name, `complete`
// asks it for its QoS and sets the type, and `destroy` ends it if that fails. `what` is the entity in errors.
template <typename Impl, typename Options, typename Create, typename Complete, typename Destroy>
rcl_ret_t init_entity(Impl*& place, const char* what, const rcl_node_t* node, NameKind kind, const char* name,
                      const Options& options, Create create, Complete complete, Destroy destroy) {
  if (place != nullptr) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("the %s is initialized already", what);
    return RCL_RET_ALREADY_INIT;
  }
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  const bool is_service = kind == NameKind::kService;
  const rcl_allocator_t& allocator = options.allocator;
  char* resolved = nullptr;
  if (const rcl_ret_t result = rcl_node_resolve_name(node, name, allocator, is_service, false, &resolved);
      result != RCL_RET_OK) {
    const bool name_is_wrong = result == RCL_RET_UNKNOWN_SUBSTITUTION || result == RCL_RET_TOPIC_NAME_INVALID;
    return !name_is_wrong ? result : is_service ? RCL_RET_SERVICE_NAME_INVALID : RCL_RET_TOPIC_NAME_INVALID;
  }
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  rmw_node_t* rmw_node = rcl_node_get_rmw_handle(node);
  impl->rmw_handle = create(rmw_node, resolved);
  allocator.deallocate(resolved, allocator.state);
  if (impl->rmw_handle == nullptr) {
    return RCL_RET_ERROR;
  }
  if (const rmw_ret_t result = complete(*impl); result != RMW_RET_OK) {
    (void)destroy(rmw_node, impl->rmw_handle);
    return result;
  }
  (void)rcl_node_type_cache_register_type(node, impl->type);
  place = impl.release();
  return RCL_RET_OK;
}

// `end` ends the handle of rmw and all that belongs to it.
template <typename Impl, typename End>
rcl_ret_t fini_entity(Impl*& place, rcl_node_t* node, End end) {
  if (!rcl_node_is_valid_except_context(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (place == nullptr) {
    return RCL_RET_OK;
  }
  (void)rcl_node_type_cache_unregister_type(node, place->type);
  const rcl_ret_t result = end(rcl_node_get_rmw_handle(node), *place);
  delete std::exchange(place, nullptr);
  return result;
}

}  // namespace rcl
