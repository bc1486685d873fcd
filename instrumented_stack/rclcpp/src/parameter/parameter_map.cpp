// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/parameter_map.hpp"

#include <memory>
#include <rcl/parameter_overrides.hpp>

#include "rclcpp/exceptions.hpp"

namespace rclcpp {
namespace {

// The list of a structure of C as a vector of C++.
template <typename T, typename ArrayT>
ParameterValue list_from(const ArrayT* values, std::size_t size) {
  return ParameterValue(std::vector<T>(values, values + size));
}

std::string in_node(std::size_t node, std::size_t parameter) {
  return "At node " + std::to_string(node) + " parameter " + std::to_string(parameter);
}

void add_parameters(const rcl_node_params_t& c_node, std::size_t node_index, std::vector<Parameter>& parameters) {
  parameters.reserve(parameters.size() + c_node.num_params);
  for (std::size_t i = 0; i < c_node.num_params; ++i) {
    const char* name = c_node.parameter_names[i];
    if (name == nullptr) {
      throw exceptions::InvalidParametersException(in_node(node_index, i) + " name is NULL");
    }
    try {
      parameters.emplace_back(name, parameter_value_from(&c_node.parameter_values[i]));
    } catch (const exceptions::InvalidParameterValueException& error) {
      throw exceptions::InvalidParameterValueException(std::string(error.what()) + ": '" + name + "'");
    }
  }
}

}  // namespace

ParameterValue parameter_value_from(const rcl_variant_t* c_value) {
  if (c_value == nullptr) {
    throw exceptions::InvalidParameterValueException("Passed argument is NULL");
  }
  if (c_value->bool_value != nullptr) {
    return ParameterValue(*c_value->bool_value);
  }
  if (c_value->integer_value != nullptr) {
    return ParameterValue(*c_value->integer_value);
  }
  if (c_value->double_value != nullptr) {
    return ParameterValue(*c_value->double_value);
  }
  if (c_value->string_value != nullptr) {
    return ParameterValue(std::string(c_value->string_value));
  }
  if (const rcl_byte_array_t* bytes = c_value->byte_array_value; bytes != nullptr) {
    return list_from<uint8_t>(bytes->values, bytes->size);
  }
  if (const rcl_bool_array_t* bools = c_value->bool_array_value; bools != nullptr) {
    return list_from<bool>(bools->values, bools->size);
  }
  if (const rcl_int64_array_t* integers = c_value->integer_array_value; integers != nullptr) {
    return list_from<int64_t>(integers->values, integers->size);
  }
  if (const rcl_double_array_t* doubles = c_value->double_array_value; doubles != nullptr) {
    return list_from<double>(doubles->values, doubles->size);
  }
  if (const rcutils_string_array_t* strings = c_value->string_array_value; strings != nullptr) {
    return list_from<std::string>(strings->data, strings->size);
  }
  throw exceptions::InvalidParameterValueException("No parameter value set");
}

ParameterMap parameter_map_from(const rcl_params_t* c_params, const char* node_fqn) {
  if (c_params == nullptr) {
    throw exceptions::InvalidParametersException("parameters struct is NULL");
  }
  if (c_params->node_names == nullptr) {
    throw exceptions::InvalidParametersException("node names array is NULL");
  }
  if (c_params->params == nullptr) {
    throw exceptions::InvalidParametersException("node params array is NULL");
  }
  ParameterMap map;
  for (std::size_t i = 0; i < c_params->num_nodes; ++i) {
    if (c_params->node_names[i] == nullptr) {
      throw exceptions::InvalidParametersException("Node name at index " + std::to_string(i) + " is NULL");
    }
    std::string name = c_params->node_names[i];
    if (!name.starts_with('/')) {
      name.insert(0, 1, '/');
    }
    if (node_fqn != nullptr && !rcl::node_pattern_matches(name, node_fqn)) {
      continue;
    }
    add_parameters(c_params->params[i], i, map[node_fqn != nullptr ? node_fqn : name]);
  }
  return map;
}

ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename, const char* node_fqn) {
  const std::unique_ptr<rcl_params_t, void (*)(rcl_params_t*)> params(
      rcl_yaml_node_struct_init(rcutils_get_default_allocator()), rcl_yaml_node_struct_fini);
  if (!rcl_parse_yaml_file(yaml_filename.c_str(), params.get())) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR);
  }
  return parameter_map_from(params.get(), node_fqn);
}

std::vector<Parameter> parameters_from_map(const ParameterMap& parameter_map, const char* node_fqn) {
  std::vector<Parameter> parameters;
  for (const auto& [pattern, of_node] : parameter_map) {
    if (node_fqn == nullptr || rcl::node_pattern_matches(pattern, node_fqn)) {
      parameters.insert(parameters.end(), of_node.begin(), of_node.end());
    }
  }
  return parameters;
}

}  // namespace rclcpp
