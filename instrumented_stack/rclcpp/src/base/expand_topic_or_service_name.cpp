// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/expand_topic_or_service_name.hpp"

#include <rcl/expand_topic_name.h>
#include <rcl/validate_topic_name.h>
#include <rmw/validate_full_topic_name.h>
#include <rmw/validate_namespace.h>
#include <rmw/validate_node_name.h>

#include "base/rcl_entity.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

namespace {

using Validate = rmw_ret_t (*)(const char*, int*, size_t*);
using ToString = const char* (*)(int);

template <typename ErrorT>
void require_valid(Validate validate, ToString to_string, const std::string& name) {
  int result = 0;
  size_t index = 0;
  if (validate(name.c_str(), &result, &index) != RMW_RET_OK) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR, "failed to validate a name");
  }
  if (result != 0) {
    throw ErrorT(name.c_str(), to_string(result), index);
  }
}

}  // namespace

std::string expand_topic_or_service_name(const std::string& name, const std::string& node_name,
                                         const std::string& namespace_, bool is_service) {
  require_valid<exceptions::InvalidNodeNameError>(rmw_validate_node_name, rmw_node_name_validation_result_string,
                                                  node_name);
  require_valid<exceptions::InvalidNamespaceError>(rmw_validate_namespace, rmw_namespace_validation_result_string,
                                                   namespace_);
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  const rcutils_string_map_t no_more_substitutions = rcutils_get_zero_initialized_string_map();
  char* expanded = nullptr;
  const rcl_ret_t ret = rcl_expand_topic_name(name.c_str(), node_name.c_str(), namespace_.c_str(),
                                              &no_more_substitutions, allocator, &expanded);
  if (ret == RCL_RET_TOPIC_NAME_INVALID || ret == RCL_RET_UNKNOWN_SUBSTITUTION) {
    is_service ? detail::throw_invalid_service_name(name) : detail::throw_invalid_topic_name(name);
  }
  detail::require_ok(ret, "failed to expand a name");
  const std::string result = expanded;
  allocator.deallocate(expanded, allocator.state);
  const auto require_valid_name = is_service ? require_valid<exceptions::InvalidServiceNameError>
                                             : require_valid<exceptions::InvalidTopicNameError>;
  require_valid_name(rmw_validate_full_topic_name, rmw_full_topic_name_validation_result_string, result);
  return result;
}

}  // namespace rclcpp

namespace rclcpp::detail {

namespace {

template <typename ErrorT>
[[noreturn]] void throw_invalid_name(rcl_ret_t ret, const char* what, const std::string& name) {
  int result = RCL_TOPIC_NAME_VALID;
  size_t index = 0;
  if (rcl_validate_topic_name(name.c_str(), &result, &index) == RCL_RET_OK && result != RCL_TOPIC_NAME_VALID) {
    rcl_reset_error();
    throw ErrorT(name.c_str(), rcl_topic_name_validation_result_string(result), index);
  }
  exceptions::throw_from_rcl_error(ret, std::string("invalid ") + what + " name '" + name + "'");
}

}  // namespace

void throw_invalid_topic_name(const std::string& name) {
  throw_invalid_name<exceptions::InvalidTopicNameError>(RCL_RET_TOPIC_NAME_INVALID, "topic", name);
}

void throw_invalid_service_name(const std::string& name) {
  throw_invalid_name<exceptions::InvalidServiceNameError>(RCL_RET_SERVICE_NAME_INVALID, "service", name);
}

}  // namespace rclcpp::detail
