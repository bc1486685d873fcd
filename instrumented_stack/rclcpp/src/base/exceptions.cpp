// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/exceptions/exceptions.hpp"

#include <rcl/error_handling.h>

#include <utility>

namespace rclcpp::exceptions {

namespace {

std::string list_arguments(const std::vector<std::string>& arguments) {
  std::string list;
  for (const std::string& argument : arguments) {
    list += (list.empty() ? "'" : ", '") + argument + "'";
  }
  return list;
}

}  // namespace

NameValidationError::NameValidationError(const char* name_type_, const char* name_, const char* error_msg_,
                                         size_t invalid_index_)
    : std::invalid_argument(format_error(name_type_, name_, error_msg_, invalid_index_)),
      name_type(name_type_),
      name(name_),
      error_msg(error_msg_),
      invalid_index(invalid_index_) {}

std::string NameValidationError::format_error(const char* name_type, const char* name, const char* error_msg,
                                              size_t invalid_index) {
  return std::string("Invalid ") + name_type + ": " + error_msg + ":\n  '" + name + "'\n   " +
         std::string(invalid_index, ' ') + "^\n";
}

RCLErrorBase::RCLErrorBase(rcl_ret_t ret_, const rcl_error_state_t* error_state)
    : ret(ret_),
      message(error_state ? error_state->message : ""),
      file(error_state ? error_state->file : ""),
      line(error_state ? error_state->line_number : 0),
      formatted_message(rcl_get_error_string().str) {}

RCLError::RCLError(rcl_ret_t ret_, const rcl_error_state_t* error_state, const std::string& prefix)
    : RCLError(RCLErrorBase(ret_, error_state), prefix) {}
RCLError::RCLError(const RCLErrorBase& base_exc, const std::string& prefix)
    : RCLErrorBase(base_exc), std::runtime_error(prefix + base_exc.formatted_message) {}

RCLBadAlloc::RCLBadAlloc(rcl_ret_t ret_, const rcl_error_state_t* error_state)
    : RCLBadAlloc(RCLErrorBase(ret_, error_state)) {}
RCLBadAlloc::RCLBadAlloc(const RCLErrorBase& base_exc) : RCLErrorBase(base_exc) {}

RCLInvalidArgument::RCLInvalidArgument(rcl_ret_t ret_, const rcl_error_state_t* error_state, const std::string& prefix)
    : RCLInvalidArgument(RCLErrorBase(ret_, error_state), prefix) {}
RCLInvalidArgument::RCLInvalidArgument(const RCLErrorBase& base_exc, const std::string& prefix)
    : RCLErrorBase(base_exc), std::invalid_argument(prefix + base_exc.formatted_message) {}

RCLInvalidROSArgsError::RCLInvalidROSArgsError(rcl_ret_t ret_, const rcl_error_state_t* error_state,
                                               const std::string& prefix)
    : RCLInvalidROSArgsError(RCLErrorBase(ret_, error_state), prefix) {}
RCLInvalidROSArgsError::RCLInvalidROSArgsError(const RCLErrorBase& base_exc, const std::string& prefix)
    : RCLErrorBase(base_exc), std::runtime_error(prefix + base_exc.formatted_message) {}

UnknownROSArgsError::UnknownROSArgsError(std::vector<std::string>&& unknown_ros_args_)
    : std::runtime_error("found unknown ROS arguments: " + list_arguments(unknown_ros_args_)),
      unknown_ros_args(std::move(unknown_ros_args_)) {}

void throw_from_rcl_error(rcl_ret_t ret, const std::string& prefix, const rcl_error_state_t* error_state,
                          void (*reset_error)()) {
  if (ret == RCL_RET_OK) {
    throw std::invalid_argument("ret is RCL_RET_OK");
  }
  if (!error_state) {
    error_state = rcl_get_error_state();
  }
  // As in ROS 2, a function of rcl that fails without a word makes an exception of its return value: "error not set".
  const RCLErrorBase base(ret, error_state);
  if (reset_error) {
    reset_error();
  }
  const std::string before = prefix.empty() ? "" : prefix + ": ";
  switch (ret) {
    case RCL_RET_BAD_ALLOC:
      throw RCLBadAlloc(base);
    case RCL_RET_INVALID_ARGUMENT:
      throw RCLInvalidArgument(base, before);
    case RCL_RET_INVALID_ROS_ARGS:
      throw RCLInvalidROSArgsError(base, before);
    default:
      throw RCLError(base, before);
  }
}

}  // namespace rclcpp::exceptions
