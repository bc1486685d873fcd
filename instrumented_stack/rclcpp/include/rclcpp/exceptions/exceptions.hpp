// SPDX-License-Identifier: Apache-2.0
// The exceptions of rclcpp. Failures of rcl become exceptions in one place: throw_from_rcl_error().
#pragma once

#include <rcl/error_handling.h>
#include <rcl/types.h>

#include <cstddef>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace rclcpp::exceptions {

// A node, namespace or topic name is malformed. what() shows the name with a caret below its first wrong character.
class NameValidationError : public std::invalid_argument {
 public:
  NameValidationError(const char* name_type, const char* name, const char* error_msg, size_t invalid_index);

  static std::string format_error(const char* name_type, const char* name, const char* error_msg, size_t invalid_index);

  const std::string name_type;
  const std::string name;
  const std::string error_msg;
  const size_t invalid_index;
};

class InvalidNodeNameError : public NameValidationError {
 public:
  InvalidNodeNameError(const char* node_name, const char* error, size_t index)
      : NameValidationError("node name", node_name, error, index) {}
};

class InvalidNamespaceError : public NameValidationError {
 public:
  InvalidNamespaceError(const char* node_namespace, const char* error, size_t index)
      : NameValidationError("namespace", node_namespace, error, index) {}
};

class InvalidTopicNameError : public NameValidationError {
 public:
  InvalidTopicNameError(const char* topic, const char* error, size_t index)
      : NameValidationError("topic name", topic, error, index) {}
};

class InvalidServiceNameError : public NameValidationError {
 public:
  InvalidServiceNameError(const char* service, const char* error, size_t index)
      : NameValidationError("service name", service, error, index) {}
};

class InvalidNodeError : public std::runtime_error {
 public:
  InvalidNodeError() : std::runtime_error("node is invalid") {}
};

class InvalidServiceTypeError : public std::runtime_error {
 public:
  InvalidServiceTypeError() : std::runtime_error("Service type is invalid.") {}
  explicit InvalidServiceTypeError(const std::string& message) : std::runtime_error(message) {}
};

class UnknownTypeError : public std::runtime_error {
 public:
  explicit UnknownTypeError(const std::string& type) : std::runtime_error("Unknown type: " + type) {}
};

class EventNotRegisteredError : public std::runtime_error {
 public:
  EventNotRegisteredError() : std::runtime_error("event already registered") {}
};

class MissingGroupNodeException : public std::runtime_error {
 public:
  explicit MissingGroupNodeException(const std::string& kind)
      : std::runtime_error("cannot create: " + kind + " , callback group not in node") {}
};

class QoSCheckCompatibleException : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class UnimplementedError : public std::runtime_error {
 public:
  UnimplementedError() : std::runtime_error("This code is unimplemented.") {}
  explicit UnimplementedError(const std::string& message) : std::runtime_error(message) {}
};

// The state of a failed rcl call: return code, message and the source line that set it.
class RCLErrorBase {
 public:
  RCLErrorBase(rcl_ret_t ret, const rcl_error_state_t* error_state);
  virtual ~RCLErrorBase() = default;

  rcl_ret_t ret;
  std::string message;
  std::string file;
  size_t line;
  std::string formatted_message;
};

class RCLError : public RCLErrorBase, public std::runtime_error {
 public:
  RCLError(rcl_ret_t ret, const rcl_error_state_t* error_state, const std::string& prefix);
  RCLError(const RCLErrorBase& base_exc, const std::string& prefix);
};

class RCLBadAlloc : public RCLErrorBase, public std::bad_alloc {
 public:
  RCLBadAlloc(rcl_ret_t ret, const rcl_error_state_t* error_state);
  explicit RCLBadAlloc(const RCLErrorBase& base_exc);
  const char* what() const noexcept override { return formatted_message.c_str(); }
};

class RCLInvalidArgument : public RCLErrorBase, public std::invalid_argument {
 public:
  RCLInvalidArgument(rcl_ret_t ret, const rcl_error_state_t* error_state, const std::string& prefix);
  RCLInvalidArgument(const RCLErrorBase& base_exc, const std::string& prefix);
};

// A token after --ros-args was recognised but is malformed.
class RCLInvalidROSArgsError : public RCLErrorBase, public std::runtime_error {
 public:
  RCLInvalidROSArgsError(rcl_ret_t ret, const rcl_error_state_t* error_state, const std::string& prefix);
  RCLInvalidROSArgsError(const RCLErrorBase& base_exc, const std::string& prefix);
};

// A token after --ros-args was not recognised.
class UnknownROSArgsError : public std::runtime_error {
 public:
  explicit UnknownROSArgsError(std::vector<std::string>&& unknown_ros_args);

  const std::vector<std::string> unknown_ros_args;
};

class InvalidParametersException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class InvalidParameterValueException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class InvalidParameterTypeException : public std::runtime_error {
 public:
  InvalidParameterTypeException(const std::string& name, const std::string& message)
      : std::runtime_error("parameter '" + name + "' has invalid type: " + message) {}
};

// A statically typed parameter was read before it got a value.
class ParameterUninitializedException : public std::runtime_error {
 public:
  explicit ParameterUninitializedException(const std::string& name)
      : std::runtime_error("parameter '" + name + "' is not initialized") {}
};

// A parameter was declared by type alone and no override gave it a value.
class UninitializedStaticallyTypedParameterException : public std::runtime_error {
 public:
  explicit UninitializedStaticallyTypedParameterException(const std::string& name)
      : std::runtime_error("Statically typed parameter '" + name + "' must be initialized.") {}
};

class ParameterAlreadyDeclaredException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterNotDeclaredException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ParameterImmutableException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An on-set callback tried to declare, undeclare or set a parameter.
class ParameterModifiedInCallbackException : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws the exception for `ret`: RCLBadAlloc, RCLInvalidArgument, RCLInvalidROSArgsError, else RCLError. `error_state`
// defaults to the error of this thread. It is copied and then cleared with `reset_error`.
[[noreturn]] void throw_from_rcl_error(rcl_ret_t ret, const std::string& prefix = "",
                                       const rcl_error_state_t* error_state = nullptr,
                                       void (*reset_error)() = rcl_reset_error);

}  // namespace rclcpp::exceptions
