// SPDX-License-Identifier: Apache-2.0
// The nodes, parameters and values in the structures of C.
#pragma once

#include <string>

#include "rcl_yaml_param_parser/read_yaml.hpp"
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

void clear_variant(rcl_variant_t& variant, const rcutils_allocator_t& allocator);

// Replaces the value. Without one, the variant is empty. Throws std::bad_alloc.
void set_variant(rcl_variant_t& variant, const std::optional<ParameterValue>& value,
                 const rcutils_allocator_t& allocator);

// Makes an empty variant equal to another one. Throws std::bad_alloc; clear_variant() then frees what is there.
void copy_variant(rcl_variant_t& target, const rcl_variant_t& source, const rcutils_allocator_t& allocator);

}  // namespace rcl_yaml
