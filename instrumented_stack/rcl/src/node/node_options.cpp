// SPDX-License-Identifier: Apache-2.0
#include "rcl/node_options.h"

#include "rcl/error_handling.h"
#include "rmw/qos_profiles.h"

rcl_node_options_t rcl_node_get_default_options(void) {
  return {rcl_get_default_allocator(), true, rcl_get_zero_initialized_arguments(), true,
          rmw_qos_profile_rosout_default};
}

rcl_ret_t rcl_node_options_copy(const rcl_node_options_t* options, rcl_node_options_t* options_out) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options_out, RCL_RET_INVALID_ARGUMENT);
  if (options == options_out) {
    RCL_SET_ERROR_MSG("node options cannot be copied to themselves");
    return RCL_RET_INVALID_ARGUMENT;
  }
  *options_out = *options;
  options_out->arguments = rcl_get_zero_initialized_arguments();
  return options->arguments.impl == nullptr ? RCL_RET_OK
                                            : rcl_arguments_copy(&options->arguments, &options_out->arguments);
}

rcl_ret_t rcl_node_options_fini(rcl_node_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  return options->arguments.impl == nullptr ? RCL_RET_OK : rcl_arguments_fini(&options->arguments);
}
