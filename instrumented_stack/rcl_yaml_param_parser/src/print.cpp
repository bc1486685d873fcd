// SPDX-License-Identifier: Apache-2.0
#include <cinttypes>
#include <cstdio>

#include "rcl_yaml_param_parser/parser.h"

namespace {

void print(bool value) {
  std::fputs(value ? "true" : "false", stdout);
}

void print(int64_t value) {
  std::printf("%" PRId64, value);
}

void print(double value) {
  std::printf("%f", value);
}

void print(const char* value) {
  std::fputs(value, stdout);
}

template <typename T>
void print_list(const T* values, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    print(values[i]);
    std::fputs(", ", stdout);
  }
}

void print(const rcl_variant_t& value) {
  if (value.bool_value != nullptr) {
    print(*value.bool_value);
  } else if (value.integer_value != nullptr) {
    print(*value.integer_value);
  } else if (value.double_value != nullptr) {
    print(*value.double_value);
  } else if (value.string_value != nullptr) {
    print(static_cast<const char*>(value.string_value));
  } else if (value.byte_array_value != nullptr) {
    for (size_t i = 0; i < value.byte_array_value->size; ++i) {
      std::printf("0x%02x, ", static_cast<unsigned>(value.byte_array_value->values[i]));
    }
  } else if (value.bool_array_value != nullptr) {
    print_list(value.bool_array_value->values, value.bool_array_value->size);
  } else if (value.integer_array_value != nullptr) {
    print_list(value.integer_array_value->values, value.integer_array_value->size);
  } else if (value.double_array_value != nullptr) {
    print_list(value.double_array_value->values, value.double_array_value->size);
  } else if (value.string_array_value != nullptr) {
    print_list<const char*>(const_cast<const char**>(value.string_array_value->data), value.string_array_value->size);
  }
}

}  // namespace

extern "C" void rcl_yaml_node_struct_print(const rcl_params_t* params_st) {
  if (params_st == nullptr) {
    return;
  }
  std::printf("\n Node Name\t\t\t\tParameters\n");
  for (size_t node = 0; node < params_st->num_nodes; ++node) {
    std::printf("%s\n", params_st->node_names[node]);
    const rcl_node_params_t& params = params_st->params[node];
    for (size_t i = 0; i < params.num_params; ++i) {
      std::printf("%50s: ", params.parameter_names[i]);
      print(params.parameter_values[i]);
      std::printf("\n");
    }
  }
}
