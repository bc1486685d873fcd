// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/rcl_arguments.hpp"

#include <memory>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

namespace {

void free_with_rcl(void* pointer) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  allocator.deallocate(pointer, allocator.state);
}

}  // namespace

std::vector<std::string> unparsed_ros_arguments(const char* const* argv, const rcl_arguments_t& arguments) {
  const int count = rcl_arguments_get_count_unparsed_ros(&arguments);
  if (count <= 0) {
    return {};
  }
  int* indices = nullptr;
  require_ok(rcl_arguments_get_unparsed_ros(&arguments, rcl_get_default_allocator(), &indices),
             "failed to get unparsed ROS arguments");
  const std::unique_ptr<int, void (*)(void*)> owner(indices, free_with_rcl);
  std::vector<std::string> unparsed;
  for (int i = 0; i < count; ++i) {
    unparsed.emplace_back(argv[indices[i]]);
  }
  return unparsed;
}

std::vector<std::string> without_ros_arguments(int argc, const char* const* argv) {
  rcl_arguments_t parsed = rcl_get_zero_initialized_arguments();
  require_ok(rcl_parse_arguments(argc, argv, rcl_get_default_allocator(), &parsed), "failed to parse arguments");
  int count = 0;
  const char** arguments = nullptr;
  const rcl_ret_t ret = rcl_remove_ros_arguments(argv, &parsed, rcl_get_default_allocator(), &count, &arguments);
  const std::unique_ptr<const char*, void (*)(void*)> owner(arguments, free_with_rcl);
  std::vector<std::string> remaining(arguments, arguments + count);
  const rcl_ret_t fini_ret = rcl_arguments_fini(&parsed);
  if (ret != RCL_RET_OK || fini_ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret != RCL_RET_OK ? ret : fini_ret, "failed to remove ROS arguments");
  }
  return remaining;
}

void parse_arguments(const std::vector<std::string>& arguments, rcl_arguments_t& parsed) {
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(argument.c_str());
  }
  require_ok(rcl_parse_arguments(static_cast<int>(argv.size()), argv.data(), rcl_get_default_allocator(), &parsed),
             "failed to parse arguments");
  std::vector<std::string> unknown = unparsed_ros_arguments(argv.data(), parsed);
  if (!unknown.empty()) {
    throw exceptions::UnknownROSArgsError(std::move(unknown));
  }
}

}  // namespace rclcpp::detail
