#include "rclcpp/detail/topic_name.hpp"

#include <rcl/validate_topic_name.h>

#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

void throw_invalid_topic_name(const std::string& name) {
  int result = RCL_TOPIC_NAME_VALID;
  size_t index = 0;
  if (rcl_validate_topic_name(name.c_str(), &result, &index) == RCL_RET_OK && result != RCL_TOPIC_NAME_VALID) {
    rcl_reset_error();
    throw exceptions::InvalidTopicNameError(name.c_str(), rcl_topic_name_validation_result_string(result), index);
  }
  exceptions::throw_from_rcl_error(RCL_RET_TOPIC_NAME_INVALID, "invalid topic name '" + name + "'");
}

}  // namespace rclcpp::detail
