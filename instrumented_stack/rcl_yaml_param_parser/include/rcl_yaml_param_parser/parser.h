// SPDX-License-Identifier: Apache-2.0
// Reads parameter files into structures of C. Where a function fails, rcutils_get_error_string() tells why. Functions
// may run at the same time on different structures.
#pragma once

#include <stdbool.h>
#include <stdlib.h>

#include "rcl_yaml_param_parser/types.h"
#include "rcl_yaml_param_parser/visibility_control.h"
#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

// An empty structure with room for 128 nodes. Null if the allocator is invalid or memory runs out.
RCL_YAML_PARAM_PARSER_PUBLIC rcl_params_t* rcl_yaml_node_struct_init(rcutils_allocator_t allocator);

// The same with room for `capacity` nodes, at least 1. The room grows when it is needed.
RCL_YAML_PARAM_PARSER_PUBLIC rcl_params_t* rcl_yaml_node_struct_init_with_capacity(size_t capacity,
                                                                                   rcutils_allocator_t allocator);

// Changes the room. RCUTILS_RET_INVALID_ARGUMENT if the nodes that are there need more; RCUTILS_RET_BAD_ALLOC.
RCL_YAML_PARAM_PARSER_PUBLIC rcutils_ret_t rcl_yaml_node_struct_reallocate(rcl_params_t* params_st, size_t new_capacity,
                                                                           rcutils_allocator_t allocator);

// A copy with memory of its own, from the same allocator. Null if memory runs out.
RCL_YAML_PARAM_PARSER_PUBLIC rcl_params_t* rcl_yaml_node_struct_copy(const rcl_params_t* params_st);

// Frees the structure and all in it.
RCL_YAML_PARAM_PARSER_PUBLIC void rcl_yaml_node_struct_fini(rcl_params_t* params_st);

// Adds the parameters of a file; values replace present ones. When the file is wrong, those before the error may have
// been added.
RCL_YAML_PARAM_PARSER_PUBLIC bool rcl_parse_yaml_file(const char* file_path, rcl_params_t* params_st);

// Sets one parameter to a value or list that is written as in a file. No text may be empty.
RCL_YAML_PARAM_PARSER_PUBLIC bool rcl_parse_yaml_value(const char* node_name, const char* param_name,
                                                       const char* yaml_value, rcl_params_t* params_st);

// The value of a parameter, which belongs to the structure. Node and parameter are added, without a value, if they are
// not there. Null if an argument is null or memory runs out.
RCL_YAML_PARAM_PARSER_PUBLIC rcl_variant_t* rcl_yaml_node_struct_get(const char* node_name, const char* param_name,
                                                                     rcl_params_t* params_st);

// Prints all nodes and parameters to stdout.
RCL_YAML_PARAM_PARSER_PUBLIC void rcl_yaml_node_struct_print(const rcl_params_t* params_st);

#ifdef __cplusplus
}
#endif
