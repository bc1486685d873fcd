// SPDX-License-Identifier: Apache-2.0
// The nodes and parameters in the structures of C.
#pragma once

#include <string>

#include "rcl_yaml_param_parser/types.h"

namespace rcl_yaml {

// Room for the parameters of a node, none yet. Throws std::bad_alloc.
void init_node_params(rcl_node_params_t& node, std::size_t capacity, const rcutils_allocator_t& allocator);
void fini_node_params(rcl_node_params_t& node, const rcutils_allocator_t& allocator);

// The index of a node or a parameter, which is added if it is not there. Throws std::bad_alloc.
std::size_t find_node(rcl_params_t& params, const std::string& name);
rcl_variant_t& find_parameter(rcl_params_t& params, std::size_t node, const std::string& name);

// Throws std::bad_alloc.
void reserve_nodes(rcl_params_t& params, std::size_t capacity, const rcutils_allocator_t& allocator);

}  // namespace rcl_yaml
