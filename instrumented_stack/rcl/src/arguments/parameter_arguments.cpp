// SPDX-License-Identifier: Apache-2.0
// The parameters of a command line, as programs in C see them.
#include <rcl_yaml_param_parser/parser.h>
#include <rcutils/strdup.h>

#include <new>

#include "arguments/arguments_impl.hpp"
#include "rcl/error_handling.h"

namespace {

void copy(const rcl::ParameterOverrides& overrides, rcl_params_t& params) {
  for (const auto& [pattern, values] : overrides.patterns()) {
    for (const auto& [name, value] : values) {
      const auto* given = std::get_if<rcl::ParameterValue>(&value);
      rcl_yaml::set_parameter(params, pattern, name, given ? std::optional<rcl::ParameterValue>(*given) : std::nullopt);
    }
  }
}

}  // namespace

extern "C" {

int rcl_arguments_get_param_files_count(const rcl_arguments_t* args) {
  return args == nullptr || args->impl == nullptr ? -1 : static_cast<int>(args->impl->parameter_files.size());
}

rcl_ret_t rcl_arguments_get_param_files(const rcl_arguments_t* arguments, rcl_allocator_t allocator,
                                        char*** parameter_files) {
  RCL_CHECK_ALLOCATOR_WITH_MSG(&allocator, "invalid allocator", return RCL_RET_INVALID_ARGUMENT);
  RCL_CHECK_ARGUMENT_FOR_NULL(arguments, RCL_RET_INVALID_ARGUMENT);
  RCL_CHECK_ARGUMENT_FOR_NULL(arguments->impl, RCL_RET_INVALID_ARGUMENT);
  RCL_CHECK_ARGUMENT_FOR_NULL(parameter_files, RCL_RET_INVALID_ARGUMENT);
  const std::vector<std::string>& files = arguments->impl->parameter_files;
  auto** copies = static_cast<char**>(allocator.zero_allocate(files.size() + 1, sizeof(char*), allocator.state));
  for (size_t i = 0; copies != nullptr && i < files.size(); ++i) {
    copies[i] = rcutils_strdup(files[i].c_str(), allocator);
    if (copies[i] == nullptr) {
      while (i > 0) {
        allocator.deallocate(copies[--i], allocator.state);
      }
      allocator.deallocate(copies, allocator.state);
      copies = nullptr;
    }
  }
  *parameter_files = copies;
  return copies == nullptr ? RCL_RET_BAD_ALLOC : RCL_RET_OK;
}

rcl_ret_t rcl_arguments_get_param_overrides(const rcl_arguments_t* arguments, rcl_params_t** parameter_overrides) {
  RCL_CHECK_ARGUMENT_FOR_NULL(arguments, RCL_RET_INVALID_ARGUMENT);
  RCL_CHECK_ARGUMENT_FOR_NULL(arguments->impl, RCL_RET_INVALID_ARGUMENT);
  RCL_CHECK_ARGUMENT_FOR_NULL(parameter_overrides, RCL_RET_INVALID_ARGUMENT);
  if (*parameter_overrides != nullptr) {
    RCL_SET_ERROR_MSG("Output parameter override pointer is not null. May leak memory.");
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (arguments->impl->parameters.empty()) {
    return RCL_RET_OK;
  }
  rcl_params_t* params = rcl_yaml_node_struct_init(rcl_get_default_allocator());
  if (params == nullptr) {
    return RCL_RET_BAD_ALLOC;
  }
  try {
    copy(arguments->impl->parameters, *params);
  } catch (const std::bad_alloc&) {
    rcl_yaml_node_struct_fini(params);
    return RCL_RET_BAD_ALLOC;
  }
  *parameter_overrides = params;
  return RCL_RET_OK;
}

}  // extern "C"
