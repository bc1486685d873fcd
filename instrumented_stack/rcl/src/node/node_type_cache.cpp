// SPDX-License-Identifier: Apache-2.0
#include "rcl/node_type_cache.h"

#include "node/type_cache.hpp"
#include "rcl/error_handling.h"

namespace rcl {

void TypeCache::add(const rosidl_type_description_t& description) {
  const std::lock_guard lock(mutex_);
  Use& use = types_[description.type_hash];
  use.description = &description;
  ++use.count;
}

bool TypeCache::remove(const rosidl_type_description_t& description) {
  const std::lock_guard lock(mutex_);
  const auto found = types_.find(description.type_hash);
  if (found == types_.end()) {
    return false;
  }
  if (--found->second.count == 0) {
    types_.erase(found);
  }
  return true;
}

const rosidl_type_description_t* TypeCache::find(const std::string& type_hash) const {
  const std::lock_guard lock(mutex_);
  const auto found = types_.find(type_hash);
  return found == types_.end() ? nullptr : found->second.description;
}

}  // namespace rcl

rcl_ret_t rcl_node_type_cache_register_type(const rcl_node_t* node, const rosidl_type_description_t* description) {
  rcl::TypeCache* cache = rcl::type_cache_of(node);
  if (cache == nullptr) {
    return RCL_RET_NODE_INVALID;
  }
  if (description != nullptr) {
    cache->add(*description);
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_type_cache_unregister_type(const rcl_node_t* node, const rosidl_type_description_t* description) {
  rcl::TypeCache* cache = rcl::type_cache_of(node);
  if (cache == nullptr) {
    return RCL_RET_NODE_INVALID;
  }
  if (description != nullptr && !cache->remove(*description)) {
    RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("type '%s' is not in use by the node", description->type_name);
    return RCL_RET_ERROR;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_node_type_cache_get_type_info(const rcl_node_t* node, const char* type_hash,
                                            const rosidl_type_description_t** description) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(type_hash, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(description, RCL_RET_INVALID_ARGUMENT);
  const rcl::TypeCache* cache = rcl::type_cache_of(node);
  if (cache == nullptr) {
    return RCL_RET_NODE_INVALID;
  }
  *description = cache->find(type_hash);
  return RCL_RET_OK;
}
