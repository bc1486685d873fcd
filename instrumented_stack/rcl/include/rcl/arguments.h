// SPDX-License-Identifier: Apache-2.0
// Parsing of the ROS part of a command line.
//
// Everything between `--ros-args` and `--` (or the end) belongs to ROS. Both may occur several times. The flags:
//   -r, --remap [node:]FROM:=TO   -p, --param [node:]NAME:=VALUE   --params-file FILE   -e, --enclave PATH
//   --log-level LEVEL | LOGGER:=LEVEL   --log-config-file FILE   --log-file-name PREFIX
//   --enable-rosout-logs, --disable-rosout-logs, and the same for stdout and external-lib
// Outside, the old form `FROM:=TO` is still a remap rule, with a warning. The rest is left to the application.
#pragma once

#include <stdbool.h>

#include "rcl/allocator.h"
#include "rcl/types.h"
#include "rcl_yaml_param_parser/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_ROS_ARGS_FLAG "--ros-args"
#define RCL_ROS_ARGS_EXPLICIT_END_TOKEN "--"
#define RCL_PARAM_FLAG "--param"
#define RCL_SHORT_PARAM_FLAG "-p"
#define RCL_PARAM_FILE_FLAG "--params-file"
#define RCL_REMAP_FLAG "--remap"
#define RCL_SHORT_REMAP_FLAG "-r"
#define RCL_ENCLAVE_FLAG "--enclave"
#define RCL_SHORT_ENCLAVE_FLAG "-e"
#define RCL_LOG_LEVEL_FLAG "--log-level"
#define RCL_EXTERNAL_LOG_CONFIG_FLAG "--log-config-file"
#define RCL_LOG_FILE_NAME_FLAG "--log-file-name"
#define RCL_EXTERNAL_LOG_FILE_NAME_PREFIX RCL_LOG_FILE_NAME_FLAG
#define RCL_LOG_STDOUT_FLAG_SUFFIX "stdout-logs"
#define RCL_LOG_ROSOUT_FLAG_SUFFIX "rosout-logs"
#define RCL_LOG_EXT_LIB_FLAG_SUFFIX "external-lib-logs"

typedef struct rcl_arguments_impl_s rcl_arguments_impl_t;

typedef struct rcl_arguments_s {
  rcl_arguments_impl_t* impl;
} rcl_arguments_t;

rcl_arguments_t rcl_get_zero_initialized_arguments(void);

// Parses the arguments; `argv` may be null if `argc` is 0. A wrong ROS argument returns RCL_RET_INVALID_ROS_ARGS and an
// error message that names the argument and the problem. An unknown flag inside `--ros-args` is kept; ask for it with
// rcl_arguments_get_count_unparsed_ros().
rcl_ret_t rcl_parse_arguments(int argc, const char* const* argv, rcl_allocator_t allocator,
                              rcl_arguments_t* args_output);

// Indices into argv of the arguments outside the ROS sections, including the program name. Free the array with the
// allocator.
int rcl_arguments_get_count_unparsed(const rcl_arguments_t* args);
rcl_ret_t rcl_arguments_get_unparsed(const rcl_arguments_t* args, rcl_allocator_t allocator,
                                     int** output_unparsed_indices);

// Arguments inside the ROS sections that belong to no known flag.
int rcl_arguments_get_count_unparsed_ros(const rcl_arguments_t* args);
rcl_ret_t rcl_arguments_get_unparsed_ros(const rcl_arguments_t* args, rcl_allocator_t allocator,
                                         int** output_unparsed_ros_indices);

// The command line without its ROS sections. The strings are those of argv. Free the array with the allocator.
rcl_ret_t rcl_remove_ros_arguments(const char* const* argv, const rcl_arguments_t* args, rcl_allocator_t allocator,
                                   int* nonros_argc, const char*** nonros_argv);

// The parameter files; -1 if the arguments were never parsed. Free each string and the array with the allocator.
int rcl_arguments_get_param_files_count(const rcl_arguments_t* args);
rcl_ret_t rcl_arguments_get_param_files(const rcl_arguments_t* arguments, rcl_allocator_t allocator,
                                        char*** parameter_files);

// The parameters of files and of `-p`, in a new structure for rcl_yaml_node_struct_fini(). Each name of a node has a
// slash in front. The pointer must be null before, and stays null if there are no parameters.
rcl_ret_t rcl_arguments_get_param_overrides(const rcl_arguments_t* arguments, rcl_params_t** parameter_overrides);

rcl_ret_t rcl_arguments_copy(const rcl_arguments_t* args, rcl_arguments_t* args_out);
rcl_ret_t rcl_arguments_fini(rcl_arguments_t* args);

#ifdef __cplusplus
}
#endif
