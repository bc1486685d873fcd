// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"
#include "rcl_yaml_param_parser/read_yaml.hpp"
#include "structures.hpp"

namespace rcl_yaml {
namespace {

constexpr std::size_t kFirstCapacity = 128;

}  // namespace

void init_node_params(rcl_node_params_t& node, std::size_t capacity, const rcutils_allocator_t& allocator) {
  node.parameter_names = zeroed<char*>(allocator, capacity);
  try {
    node.parameter_values = zeroed<rcl_variant_t>(allocator, capacity);
  } catch (const std::bad_alloc&) {
    release(allocator, node.parameter_names);
    throw;
  }
  node.num_params = 0;
  node.capacity_params = capacity;
}

void fini_node_params(rcl_node_params_t& node, const rcutils_allocator_t& allocator) {
  for (std::size_t i = 0; i < node.num_params; ++i) {
    release(allocator, node.parameter_names[i]);
    clear_variant(node.parameter_values[i], allocator);
  }
  release(allocator, node.parameter_names);
  release(allocator, node.parameter_values);
  node.num_params = 0;
  node.capacity_params = 0;
}

void reserve_nodes(rcl_params_t& params, std::size_t capacity, const rcutils_allocator_t& allocator) {
  resize(allocator, params.node_names, params.capacity_nodes, capacity);
  resize(allocator, params.params, params.capacity_nodes, capacity);
  params.capacity_nodes = capacity;
}

std::size_t find_node(rcl_params_t& params, const std::string& name) {
  for (std::size_t i = 0; i < params.num_nodes; ++i) {
    if (name == params.node_names[i]) {
      return i;
    }
  }
  if (params.num_nodes == params.capacity_nodes) {
    reserve_nodes(params, params.capacity_nodes * 2, params.allocator);
  }
  char*& new_name = params.node_names[params.num_nodes];
  new_name = copy_text(params.allocator, name);
  try {
    init_node_params(params.params[params.num_nodes], kFirstCapacity, params.allocator);
  } catch (const std::bad_alloc&) {
    release(params.allocator, new_name);
    throw;
  }
  return params.num_nodes++;
}

rcl_variant_t& find_parameter(rcl_params_t& params, std::size_t node_index, const std::string& name) {
  rcl_node_params_t& node = params.params[node_index];
  for (std::size_t i = 0; i < node.num_params; ++i) {
    if (name == node.parameter_names[i]) {
      return node.parameter_values[i];
    }
  }
  if (node.num_params == node.capacity_params) {
    const std::size_t capacity = node.capacity_params * 2;
    resize(params.allocator, node.parameter_names, node.capacity_params, capacity);
    resize(params.allocator, node.parameter_values, node.capacity_params, capacity);
    node.capacity_params = capacity;
  }
  node.parameter_names[node.num_params] = copy_text(params.allocator, name);
  return node.parameter_values[node.num_params++];
}

void set_parameter(rcl_params_t& params, const std::string& node, const std::string& name,
                   const std::optional<ParameterValue>& value) {
  set_variant(find_parameter(params, find_node(params, node), name), value, params.allocator);
}

}  // namespace rcl_yaml
