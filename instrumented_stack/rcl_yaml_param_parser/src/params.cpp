// SPDX-License-Identifier: Apache-2.0
#include <rcutils/error_handling.h>

#include "memory.hpp"
#include "rcl_yaml_param_parser/parser.h"
#include "structures.hpp"

namespace {

constexpr std::size_t kFirstCapacity = 128;

rcl_params_t* init(std::size_t capacity, const rcutils_allocator_t& allocator) {
  auto* params = rcl_yaml::zeroed<rcl_params_t>(allocator);
  params->allocator = allocator;
  try {
    params->node_names = rcl_yaml::zeroed<char*>(allocator, capacity);
    params->params = rcl_yaml::zeroed<rcl_node_params_t>(allocator, capacity);
  } catch (const std::bad_alloc&) {
    rcl_yaml_node_struct_fini(params);
    throw;
  }
  params->capacity_nodes = capacity;
  return params;
}

// Adds the nodes of another structure to one that has room for them.
void copy_nodes(rcl_params_t& target, const rcl_params_t& source) {
  const rcutils_allocator_t& allocator = target.allocator;
  for (std::size_t node = 0; node < source.num_nodes; ++node) {
    const rcl_node_params_t& from = source.params[node];
    rcl_node_params_t& to = target.params[node];
    target.node_names[node] = rcl_yaml::copy_text(allocator, source.node_names[node]);
    ++target.num_nodes;
    rcl_yaml::init_node_params(to, from.capacity_params, allocator);
    for (std::size_t i = 0; i < from.num_params; ++i) {
      to.parameter_names[i] = rcl_yaml::copy_text(allocator, from.parameter_names[i]);
      ++to.num_params;
      rcl_yaml::copy_variant(to.parameter_values[i], from.parameter_values[i], allocator);
    }
  }
}

}  // namespace

extern "C" {

rcl_params_t* rcl_yaml_node_struct_init(rcutils_allocator_t allocator) {
  return rcl_yaml_node_struct_init_with_capacity(kFirstCapacity, allocator);
}

rcl_params_t* rcl_yaml_node_struct_init_with_capacity(size_t capacity, rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "invalid allocator", return nullptr);
  if (capacity == 0) {
    RCUTILS_SET_ERROR_MSG("capacity can't be zero");
    return nullptr;
  }
  try {
    return init(capacity, allocator);
  } catch (const std::bad_alloc&) {
    RCUTILS_SET_ERROR_MSG("no memory for parameters");
    return nullptr;
  }
}

rcutils_ret_t rcl_yaml_node_struct_reallocate(rcl_params_t* params_st, size_t new_capacity,
                                              rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(params_st, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "invalid allocator", return RCUTILS_RET_INVALID_ARGUMENT);
  if (new_capacity < params_st->num_nodes) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("new capacity '%zu' must be greater than or equal to '%zu'", new_capacity,
                                             params_st->num_nodes);
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  try {
    rcl_yaml::reserve_nodes(*params_st, new_capacity, allocator);
  } catch (const std::bad_alloc&) {
    RCUTILS_SET_ERROR_MSG("no memory for parameters");
    return RCUTILS_RET_BAD_ALLOC;
  }
  return RCUTILS_RET_OK;
}

rcl_params_t* rcl_yaml_node_struct_copy(const rcl_params_t* params_st) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(params_st, nullptr);
  rcl_params_t* copy = rcl_yaml_node_struct_init_with_capacity(params_st->capacity_nodes, params_st->allocator);
  if (copy == nullptr) {
    return nullptr;
  }
  try {
    copy_nodes(*copy, *params_st);
  } catch (const std::bad_alloc&) {
    RCUTILS_SET_ERROR_MSG("no memory for parameters");
    rcl_yaml_node_struct_fini(copy);
    return nullptr;
  }
  return copy;
}

void rcl_yaml_node_struct_fini(rcl_params_t* params_st) {
  if (params_st == nullptr) {
    return;
  }
  const rcutils_allocator_t allocator = params_st->allocator;
  for (size_t i = 0; i < params_st->num_nodes; ++i) {
    rcl_yaml::release(allocator, params_st->node_names[i]);
    rcl_yaml::fini_node_params(params_st->params[i], allocator);
  }
  rcl_yaml::release(allocator, params_st->node_names);
  rcl_yaml::release(allocator, params_st->params);
  rcl_yaml::release(allocator, params_st);
}

}  // extern "C"
