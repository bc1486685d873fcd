// SPDX-License-Identifier: Apache-2.0
#include "rcl/init_options.h"

#include <new>

#include "rcl/error_handling.h"

struct rcl_init_options_impl_s {
  rmw_init_options_t rmw_init_options;
};

namespace {

rcl_ret_t check_unused(const rcl_init_options_t* init_options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(init_options, RCL_RET_INVALID_ARGUMENT);
  if (init_options->impl != nullptr) {
    RCL_SET_ERROR_MSG("init options are initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  return RCL_RET_OK;
}

rcl_ret_t check_valid(const rcl_init_options_t* init_options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(init_options, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(init_options->impl, "init options are not initialized",
                                  return RCL_RET_INVALID_ARGUMENT);
  return RCL_RET_OK;
}

}  // namespace

rcl_init_options_t rcl_get_zero_initialized_init_options(void) {
  return {};
}

rcl_ret_t rcl_init_options_init(rcl_init_options_t* init_options, rcl_allocator_t allocator) {
  if (const rcl_ret_t result = check_unused(init_options); result != RCL_RET_OK) {
    return result;
  }
  rmw_init_options_t options = rmw_get_zero_initialized_init_options();
  if (const rmw_ret_t result = rmw_init_options_init(&options, allocator); result != RMW_RET_OK) {
    return result;
  }
  init_options->impl = new rcl_init_options_impl_s{options};
  return RCL_RET_OK;
}

rcl_ret_t rcl_init_options_copy(const rcl_init_options_t* src, rcl_init_options_t* dst) {
  if (const rcl_ret_t result = check_valid(src); result != RCL_RET_OK) {
    return result;
  }
  if (const rcl_ret_t result = check_unused(dst); result != RCL_RET_OK) {
    return result;
  }
  rmw_init_options_t options = rmw_get_zero_initialized_init_options();
  if (const rmw_ret_t result = rmw_init_options_copy(&src->impl->rmw_init_options, &options); result != RMW_RET_OK) {
    return result;
  }
  dst->impl = new rcl_init_options_impl_s{options};
  return RCL_RET_OK;
}

rcl_ret_t rcl_init_options_fini(rcl_init_options_t* init_options) {
  if (const rcl_ret_t result = check_valid(init_options); result != RCL_RET_OK) {
    return result;
  }
  const rmw_ret_t result = rmw_init_options_fini(&init_options->impl->rmw_init_options);
  delete init_options->impl;
  init_options->impl = nullptr;
  return result;
}

rcl_ret_t rcl_init_options_get_domain_id(const rcl_init_options_t* init_options, size_t* domain_id) {
  if (const rcl_ret_t result = check_valid(init_options); result != RCL_RET_OK) {
    return result;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(domain_id, RCL_RET_INVALID_ARGUMENT);
  *domain_id = init_options->impl->rmw_init_options.domain_id;
  return RCL_RET_OK;
}

rcl_ret_t rcl_init_options_set_domain_id(rcl_init_options_t* init_options, size_t domain_id) {
  if (const rcl_ret_t result = check_valid(init_options); result != RCL_RET_OK) {
    return result;
  }
  init_options->impl->rmw_init_options.domain_id = domain_id;
  return RCL_RET_OK;
}

rmw_init_options_t* rcl_init_options_get_rmw_init_options(rcl_init_options_t* init_options) {
  return check_valid(init_options) == RCL_RET_OK ? &init_options->impl->rmw_init_options : nullptr;
}
