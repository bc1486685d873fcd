// SPDX-License-Identifier: Apache-2.0
#include "rcl/init.h"

#include <atomic>
#include <memory>
#include <string>

#include "arguments/arguments_impl.hpp"
#include "context/context_impl.hpp"
#include "names/c_string.hpp"
#include "rcl/discovery_options.h"
#include "rcl/domain_id.h"
#include "rcl/error_handling.h"
#include "tracetools/tracetools.h"

namespace {

uint64_t next_instance_id() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

// The command line and the environment decide what the options leave open.
rcl_ret_t complete(rmw_init_options_t& options, const rcl_arguments_t& arguments) {
  if (options.domain_id == RCL_DEFAULT_DOMAIN_ID) {
    if (const rcl_ret_t result = rcl_get_default_domain_id(&options.domain_id); result != RCL_RET_OK) {
      return result;
    }
  }
  if (options.discovery_options.automatic_discovery_range == RMW_AUTOMATIC_DISCOVERY_RANGE_NOT_SET) {
    if (const rcl_ret_t result = rcl_get_automatic_discovery_range(&options.discovery_options); result != RCL_RET_OK) {
      return result;
    }
    if (const rcl_ret_t result = rcl_get_discovery_static_peers(&options.discovery_options); result != RCL_RET_OK) {
      return result;
    }
  }
  if (options.enclave == nullptr) {
    return rcl::hand_out(arguments.impl->enclave.value_or("/"), options.allocator, &options.enclave);
  }
  return RCL_RET_OK;
}

// Fills `context` except for its instance id. On failure, the caller frees the parts created so far.
rcl_ret_t initialize(int argc, char const* const* argv, const rcl_init_options_t& options, uint64_t instance_id,
                     rcl_context_t& context) {
  rcl_context_impl_t& impl = *context.impl;
  if (const rcl_ret_t result = rcl_init_options_copy(&options, &impl.init_options); result != RCL_RET_OK) {
    return result;
  }
  rmw_init_options_t& rmw_options = *rcl_init_options_get_rmw_init_options(&impl.init_options);
  if (const rcl_ret_t result = rcl_parse_arguments(argc, argv, rmw_options.allocator, &context.global_arguments);
      result != RCL_RET_OK) {
    return result;
  }
  if (const rcl_ret_t result = complete(rmw_options, context.global_arguments); result != RCL_RET_OK) {
    return result;
  }
  rmw_options.instance_id = instance_id;
  return rmw_init(&rmw_options, &impl.rmw_context);
}

}  // namespace

rcl_ret_t rcl_init(int argc, char const* const* argv, const rcl_init_options_t* options, rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options->impl, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  if (context->impl != nullptr) {
    RCL_SET_ERROR_MSG("the context is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  const uint64_t instance_id = next_instance_id();
  context->impl = new rcl_context_impl_s;
  const rcl_ret_t result = initialize(argc, argv, *options, instance_id, *context);
  if (result != RCL_RET_OK) {
    if (context->impl->init_options.impl != nullptr) {
      (void)rcl_init_options_fini(&context->impl->init_options);
    }
    if (context->global_arguments.impl != nullptr) {
      (void)rcl_arguments_fini(&context->global_arguments);
    }
    delete context->impl;
    *context = rcl_get_zero_initialized_context();
    return result;
  }
  std::atomic_ref(context->instance_id_storage).store(instance_id);
  TRACETOOLS_TRACEPOINT(rcl_init, static_cast<const void*>(context));
  return RCL_RET_OK;
}

rcl_ret_t rcl_shutdown(rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return RCL_RET_INVALID_ARGUMENT);
  if (std::atomic_ref(context->instance_id_storage).exchange(0) == 0) {
    RCL_SET_ERROR_MSG("the context is shut down already");
    return RCL_RET_ALREADY_SHUTDOWN;
  }
  return rmw_shutdown(&context->impl->rmw_context);
}
