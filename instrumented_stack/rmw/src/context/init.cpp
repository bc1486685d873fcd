// SPDX-License-Identifier: Apache-2.0
// Init options and contexts.
#include "rmw/init.h"

#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "context/context_impl.hpp"
#include "participant/abandoned_memory.hpp"
#include "rmw/error_handling.h"
#include "types/identifier.hpp"

using rmw_fastrtps::kIdentifier;

const char* const rmw_fastrtps::kIdentifier = "rmw_fastrtps_cpp";

const char* rmw_get_implementation_identifier(void) {
  return kIdentifier;
}

const char* rmw_get_serialization_format(void) {
  return "cdr";
}

rmw_init_options_t rmw_get_zero_initialized_init_options(void) {
  return {};
}

rmw_ret_t rmw_init_options_init(rmw_init_options_t* init_options, rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(init_options, RMW_RET_INVALID_ARGUMENT);
  if (!rcutils_allocator_is_valid(&allocator)) {
    RMW_SET_ERROR_MSG("init options need a valid allocator");
    return RMW_RET_INVALID_ARGUMENT;
  }
  if (init_options->implementation_identifier != nullptr) {
    RMW_SET_ERROR_MSG("init options are initialized already");
    return RMW_RET_INVALID_ARGUMENT;
  }
  *init_options = {};
  init_options->implementation_identifier = kIdentifier;
  init_options->domain_id = RMW_DEFAULT_DOMAIN_ID;
  init_options->allocator = allocator;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_copy(const rmw_init_options_t* src, rmw_init_options_t* dst) {
  RMW_CHECK_HANDLE(src, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(dst, RMW_RET_INVALID_ARGUMENT);
  if (dst->implementation_identifier != nullptr) {
    RMW_SET_ERROR_MSG("init options to copy to are initialized already");
    return RMW_RET_INVALID_ARGUMENT;
  }
  char* enclave = nullptr;
  if (src->enclave != nullptr) {
    const std::size_t size = std::strlen(src->enclave) + 1;
    enclave = static_cast<char*>(src->allocator.allocate(size, src->allocator.state));
    if (enclave == nullptr) {
      RMW_SET_ERROR_MSG("out of memory for init options");
      return RMW_RET_BAD_ALLOC;
    }
    std::memcpy(enclave, src->enclave, size);
  }
  *dst = *src;
  dst->enclave = enclave;
  return RMW_RET_OK;
}

rmw_ret_t rmw_init_options_fini(rmw_init_options_t* init_options) {
  RMW_CHECK_HANDLE(init_options, RMW_RET_INVALID_ARGUMENT);
  if (init_options->enclave != nullptr) {
    init_options->allocator.deallocate(init_options->enclave, init_options->allocator.state);
  }
  *init_options = rmw_get_zero_initialized_init_options();
  return RMW_RET_OK;
}

rmw_context_t rmw_get_zero_initialized_context(void) {
  return {};
}

rmw_ret_t rmw_init(const rmw_init_options_t* options, rmw_context_t* context) try {
  RMW_CHECK_HANDLE(options, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(context, RMW_RET_INVALID_ARGUMENT);
  if (context->implementation_identifier != nullptr) {
    RMW_SET_ERROR_MSG("context is initialized already");
    return RMW_RET_INVALID_ARGUMENT;
  }
  rmw_fastrtps::remove_abandoned_memory();
  auto impl = std::make_unique<rmw_context_impl_s>(context);
  rmw_init_options_t copy = rmw_get_zero_initialized_init_options();
  if (const rmw_ret_t result = rmw_init_options_copy(options, &copy); result != RMW_RET_OK) {
    return result;
  }
  context->instance_id = options->instance_id;
  context->implementation_identifier = kIdentifier;
  context->options = copy;
  context->actual_domain_id = options->domain_id == RMW_DEFAULT_DOMAIN_ID ? 0 : options->domain_id;
  context->impl = impl.release();
  return RMW_RET_OK;
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for a context");
  return RMW_RET_BAD_ALLOC;
}

rmw_ret_t rmw_shutdown(rmw_context_t* context) {
  RMW_CHECK_HANDLE(context, RMW_RET_INVALID_ARGUMENT);
  std::lock_guard lock(context->impl->mutex);
  context->impl->shut_down = true;
  if (context->impl->participant != nullptr) {
    // What is destroyed from now on goes together with the participant.
    context->impl->channel->end();
    context->impl->participant->end_endpoints_silently();
  }
  context->impl->graph_changes.end();
  return RMW_RET_OK;
}

rmw_ret_t rmw_context_fini(rmw_context_t* context) {
  RMW_CHECK_HANDLE(context, RMW_RET_INVALID_ARGUMENT);
  if (!context->impl->shut_down) {
    RMW_SET_ERROR_MSG("context must be shut down before it is finalized");
    return RMW_RET_INVALID_ARGUMENT;
  }
  if (context->impl->nodes != 0) {
    RMW_SET_ERROR_MSG("context has nodes: destroy them before it is finalized");
    return RMW_RET_ERROR;
  }
  delete context->impl;
  const rmw_ret_t result = rmw_init_options_fini(&context->options);
  *context = rmw_get_zero_initialized_context();
  return result;
}
