// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/topic_name.hpp"

#include <rcl/validate_topic_name.h>

#include "rclcpp/exceptions.hpp"

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
