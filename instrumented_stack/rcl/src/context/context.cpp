// SPDX-License-Identifier: Apache-2.0
#include "rcl/context.h"

#include <tracetools/tracetools.h>

#include <atomic>

#include "context/context_impl.hpp"
#include "rcl/error_handling.h"

namespace {

// rcl_shutdown() may run in another thread.
std::atomic_ref<uint64_t> instance_id(const rcl_context_t* context) {
  return std::atomic_ref(const_cast<rcl_context_t*>(context)->instance_id_storage);
}

}  // namespace

rcl_context_t rcl_get_zero_initialized_context(void) {
  return {};
}

rcl_ret_t rcl_context_fini(rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  if (context->impl == nullptr) {
    return RCL_RET_OK;
  }
  if (rcl_context_is_valid(context)) {
    RCL_SET_ERROR_MSG("the context must be shut down before it is finalized");
    return RCL_RET_INVALID_ARGUMENT;
  }
  TRACETOOLS_EXT_TRACEPOINT(rcl_context_fini, static_cast<const void*>(context));
  const rmw_ret_t result = rmw_context_fini(&context->impl->rmw_context);
  if (result != RMW_RET_OK) {
    return result;
  }
  (void)rcl_init_options_fini(&context->impl->init_options);
  delete context->impl;
  if (context->global_arguments.impl != nullptr) {
    (void)rcl_arguments_fini(&context->global_arguments);
  }
  *context = rcl_get_zero_initialized_context();
  return RCL_RET_OK;
}

const rcl_init_options_t* rcl_context_get_init_options(const rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, nullptr);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return nullptr);
  return &context->impl->init_options;
}

rcl_context_instance_id_t rcl_context_get_instance_id(const rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, 0);
  return instance_id(context).load();
}

rcl_ret_t rcl_context_get_domain_id(rcl_context_t* context, size_t* domain_id) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(domain_id, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return RCL_RET_NOT_INIT);
  *domain_id = context->impl->rmw_context.actual_domain_id;
  return RCL_RET_OK;
}

[[gnu::hot]] bool rcl_context_is_valid(const rcl_context_t* context) {
  return context != nullptr && instance_id(context).load() != 0;
}

rmw_context_t* rcl_context_get_rmw_context(rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, nullptr);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return nullptr);
  return &context->impl->rmw_context;
}
