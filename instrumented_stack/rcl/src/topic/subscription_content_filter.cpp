// SPDX-License-Identifier: Apache-2.0
// Content filters, in the options of a new subscription and of an existing one.
#include <new>

#include "rcl/error_handling.h"
#include "rcl/subscription.h"
#include "rmw/rmw.h"

rcl_ret_t rcl_subscription_options_fini(rcl_subscription_options_t* option) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(option, RCL_RET_INVALID_ARGUMENT);
  rmw_subscription_content_filter_options_t* filter = option->rmw_subscription_options.content_filter_options;
  if (filter == nullptr) {
    return RCL_RET_OK;
  }
  const rmw_ret_t result = rmw_subscription_content_filter_options_fini(filter, &option->allocator);
  option->allocator.deallocate(filter, option->allocator.state);
  option->rmw_subscription_options.content_filter_options = nullptr;
  return result;
}

rcl_ret_t rcl_subscription_options_set_content_filter_options(const char* filter_expression,
                                                              size_t expression_parameters_argc,
                                                              const char* const expression_parameter_argv[],
                                                              rcl_subscription_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(filter_expression, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  const rcl_allocator_t& allocator = options->allocator;
  void* memory = allocator.allocate(sizeof(rmw_subscription_content_filter_options_t), allocator.state);
  if (memory == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for a content filter");
    return RCL_RET_BAD_ALLOC;
  }
  auto* filter =
      new (memory) rmw_subscription_content_filter_options_t(rmw_get_zero_initialized_content_filter_options());
  const rmw_ret_t result = rmw_subscription_content_filter_options_init(filter_expression, expression_parameters_argc,
                                                                        expression_parameter_argv, &allocator, filter);
  if (result != RMW_RET_OK) {
    allocator.deallocate(filter, allocator.state);
    return result;
  }
  const rcl_ret_t freed = rcl_subscription_options_fini(options);
  options->rmw_subscription_options.content_filter_options = filter;
  return freed;
}

rcl_subscription_content_filter_options_t rcl_get_zero_initialized_subscription_content_filter_options(void) {
  return {rmw_get_zero_initialized_content_filter_options()};
}

rcl_ret_t rcl_subscription_content_filter_options_init(const rcl_subscription_t* subscription,
                                                       const char* filter_expression, size_t expression_parameters_argc,
                                                       const char* const expression_parameter_argv[],
                                                       rcl_subscription_content_filter_options_t* options) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  return rmw_subscription_content_filter_options_init(
      filter_expression, expression_parameters_argc, expression_parameter_argv,
      &rcl_subscription_get_options(subscription)->allocator, &options->rmw_subscription_content_filter_options);
}

rcl_ret_t rcl_subscription_content_filter_options_fini(const rcl_subscription_t* subscription,
                                                       rcl_subscription_content_filter_options_t* options) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  return rmw_subscription_content_filter_options_fini(&options->rmw_subscription_content_filter_options,
                                                      &rcl_subscription_get_options(subscription)->allocator);
}

bool rcl_subscription_is_cft_supported(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription);
}

bool rcl_subscription_is_cft_enabled(const rcl_subscription_t* subscription) {
  return rcl_subscription_is_valid(subscription) && rcl_subscription_get_rmw_handle(subscription)->is_cft_enabled;
}

rcl_ret_t rcl_subscription_set_content_filter(const rcl_subscription_t* subscription,
                                              const rcl_subscription_content_filter_options_t* options) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  return rmw_subscription_set_content_filter(rcl_subscription_get_rmw_handle(subscription),
                                             &options->rmw_subscription_content_filter_options);
}

rcl_ret_t rcl_subscription_get_content_filter(const rcl_subscription_t* subscription,
                                              rcl_subscription_content_filter_options_t* options) {
  if (!rcl_subscription_is_valid(subscription)) {
    return RCL_RET_SUBSCRIPTION_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  rcl_allocator_t allocator = rcl_subscription_get_options(subscription)->allocator;
  return rmw_subscription_get_content_filter(rcl_subscription_get_rmw_handle(subscription), &allocator,
                                             &options->rmw_subscription_content_filter_options);
}
