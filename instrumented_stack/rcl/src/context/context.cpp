// SPDX-License-Identifier: Apache-2.0
// A context, from rcl_init() to its end.
#include "rcl/context.h"

#include <atomic>

#include "arguments/arguments_impl.hpp"
#include "names/names.hpp"
#include "rcl/discovery_options.h"
#include "rcl/domain_id.h"
#include "rcl/error_handling.h"
#include "rcl/init.h"
#include "tracetools/tracetools.h"

// The state behind rcl_context_t.
struct rcl_context_impl_s {
  rcl_init_options_t init_options = rcl_get_zero_initialized_init_options();
  rmw_context_t rmw_context = rmw_get_zero_initialized_context();
};

namespace {

// rcl_shutdown() may run in another thread.
std::atomic_ref<uint64_t> instance_id_of(const rcl_context_t* context) {
  return std::atomic_ref(const_cast<rcl_context_t*>(context)->instance_id_storage);
}

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
  instance_id_of(context).store(instance_id);
  TRACETOOLS_TRACEPOINT(rcl_init, static_cast<const void*>(context));
  return RCL_RET_OK;
}

rcl_ret_t rcl_shutdown(rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return RCL_RET_INVALID_ARGUMENT);
  if (instance_id_of(context).exchange(0) == 0) {
    RCL_SET_ERROR_MSG("the context is shut down already");
    return RCL_RET_ALREADY_SHUTDOWN;
  }
  return rmw_shutdown(&context->impl->rmw_context);
}

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
  return instance_id_of(context).load();
}

rcl_ret_t rcl_context_get_domain_id(rcl_context_t* context, size_t* domain_id) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(domain_id, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return RCL_RET_NOT_INIT);
  *domain_id = context->impl->rmw_context.actual_domain_id;
  return RCL_RET_OK;
}

[[gnu::hot]] bool rcl_context_is_valid(const rcl_context_t* context) {
  return context != nullptr && instance_id_of(context).load() != 0;
}

rmw_context_t* rcl_context_get_rmw_context(rcl_context_t* context) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, nullptr);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(context->impl, "the context is not initialized", return nullptr);
  return &context->impl->rmw_context;
}
