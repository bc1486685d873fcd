// SPDX-License-Identifier: Apache-2.0
#include "rmw/subscription_content_filter_options.h"

#include <cstring>

#include "rmw/error_handling.h"

namespace {

char* copy_of(const char* text, const rcutils_allocator_t& allocator) {
  const std::size_t size = std::strlen(text) + 1;
  auto* copy = static_cast<char*>(allocator.allocate(size, allocator.state));
  return copy == nullptr ? nullptr : static_cast<char*>(std::memcpy(copy, text, size));
}

}  // namespace

rmw_subscription_content_filter_options_t rmw_get_zero_initialized_content_filter_options(void) {
  return {nullptr, rcutils_get_zero_initialized_string_array()};
}

rmw_ret_t rmw_subscription_content_filter_options_init(const char* filter_expression, size_t expression_parameters_argc,
                                                       const char* const expression_parameter_argv[],
                                                       const rcutils_allocator_t* allocator,
                                                       rmw_subscription_content_filter_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(filter_expression, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RMW_RET_INVALID_ARGUMENT);
  if (expression_parameters_argc > 0) {
    RCUTILS_CHECK_ARGUMENT_FOR_NULL(expression_parameter_argv, RMW_RET_INVALID_ARGUMENT);
  }
  rmw_subscription_content_filter_options_t made = rmw_get_zero_initialized_content_filter_options();
  made.filter_expression = copy_of(filter_expression, *allocator);
  bool complete = made.filter_expression != nullptr;
  if (expression_parameters_argc > 0) {
    complete = complete && rcutils_string_array_init(&made.expression_parameters, expression_parameters_argc,
                                                     allocator) == RCUTILS_RET_OK;
  }
  for (std::size_t i = 0; complete && i < expression_parameters_argc; ++i) {
    made.expression_parameters.data[i] = copy_of(expression_parameter_argv[i], *allocator);
    complete = made.expression_parameters.data[i] != nullptr;
  }
  if (!complete) {
    (void)rmw_subscription_content_filter_options_fini(&made, allocator);
    RMW_SET_ERROR_MSG("out of memory for a content filter");
    return RMW_RET_BAD_ALLOC;
  }
  *options = made;
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_content_filter_options_fini(rmw_subscription_content_filter_options_t* options,
                                                       const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  allocator->deallocate(options->filter_expression, allocator->state);
  const bool has_parameters = options->expression_parameters.data != nullptr;
  const bool freed = !has_parameters || rcutils_string_array_fini(&options->expression_parameters) == RCUTILS_RET_OK;
  *options = rmw_get_zero_initialized_content_filter_options();
  return freed ? RMW_RET_OK : RMW_RET_ERROR;
}
