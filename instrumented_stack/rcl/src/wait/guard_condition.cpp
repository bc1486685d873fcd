// SPDX-License-Identifier: Apache-2.0
#include "rcl/guard_condition.h"

#include "rcl/error_handling.h"
#include "rmw/rmw.h"

struct rcl_guard_condition_impl_s {
  const rmw_guard_condition_t* rmw_handle;
  bool owned;
};

namespace {

rcl_ret_t init(rcl_guard_condition_t* guard_condition, const rmw_guard_condition_t* rmw_guard_condition, bool owned,
               rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(guard_condition, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  if (guard_condition->impl != nullptr) {
    RCL_SET_ERROR_MSG("the guard condition is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (!rcl_context_is_valid(context)) {
    RCL_SET_ERROR_MSG("a guard condition needs a context that is initialized and not shut down");
    return RCL_RET_NOT_INIT;
  }
  if (owned) {
    rmw_guard_condition = rmw_create_guard_condition(rcl_context_get_rmw_context(context));
    if (rmw_guard_condition == nullptr) {
      return RCL_RET_ERROR;
    }
  }
  guard_condition->context = context;
  guard_condition->impl = new rcl_guard_condition_impl_s{rmw_guard_condition, owned};
  return RCL_RET_OK;
}

}  // namespace

rcl_guard_condition_t rcl_get_zero_initialized_guard_condition(void) {
  return {};
}

rcl_guard_condition_options_t rcl_guard_condition_get_default_options(void) {
  return {rcl_get_default_allocator()};
}

rcl_ret_t rcl_guard_condition_init(rcl_guard_condition_t* guard_condition, rcl_context_t* context,
                                   const rcl_guard_condition_options_t) {
  return init(guard_condition, nullptr, true, context);
}

rcl_ret_t rcl_guard_condition_init_from_rmw(rcl_guard_condition_t* guard_condition,
                                            const rmw_guard_condition_t* rmw_guard_condition, rcl_context_t* context,
                                            const rcl_guard_condition_options_t) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(rmw_guard_condition, RCL_RET_INVALID_ARGUMENT);
  return init(guard_condition, rmw_guard_condition, false, context);
}

rcl_ret_t rcl_guard_condition_fini(rcl_guard_condition_t* guard_condition) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(guard_condition, RCL_RET_INVALID_ARGUMENT);
  if (guard_condition->impl == nullptr) {
    return RCL_RET_OK;
  }
  rmw_ret_t result = RMW_RET_OK;
  if (guard_condition->impl->owned) {
    result = rmw_destroy_guard_condition(const_cast<rmw_guard_condition_t*>(guard_condition->impl->rmw_handle));
  }
  delete guard_condition->impl;
  guard_condition->impl = nullptr;
  return result;
}

rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t* guard_condition) {
  const rmw_guard_condition_t* handle = rcl_guard_condition_get_rmw_handle(guard_condition);
  return handle == nullptr ? RCL_RET_INVALID_ARGUMENT : rmw_trigger_guard_condition(handle);
}

rmw_guard_condition_t* rcl_guard_condition_get_rmw_handle(const rcl_guard_condition_t* guard_condition) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(guard_condition, nullptr);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(guard_condition->impl, "the guard condition is not initialized", return nullptr);
  return const_cast<rmw_guard_condition_t*>(guard_condition->impl->rmw_handle);
}
