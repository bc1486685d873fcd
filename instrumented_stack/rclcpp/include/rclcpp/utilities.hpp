// SPDX-License-Identifier: Apache-2.0
// Begin and end of a ROS program.
//
//   rclcpp::init(argc, argv);
//   rclcpp::spin(std::make_shared<MyNode>());
//   rclcpp::shutdown();
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/init_options.hpp"

namespace rclcpp {

// The signals that end the contexts that were initialised with shutdown_on_signal.
enum class SignalHandlerOptions {
  All,  // SIGINT and SIGTERM
  SigInt,
  SigTerm,
  None,
};

// Initialises the default context from the command line and installs the signal handlers.
void init(int argc, char const* const* argv, const InitOptions& init_options = InitOptions(),
          SignalHandlerOptions signal_handler_options = SignalHandlerOptions::All);

// Makes the signals shut contexts down. Returns false if the handlers are installed already.
bool install_signal_handlers(SignalHandlerOptions signal_handler_options = SignalHandlerOptions::All);
bool signal_handlers_installed();
SignalHandlerOptions get_current_signal_handler_options();
// Restores the previous handlers. Returns false if none were installed.
bool uninstall_signal_handlers();

// Calls init() and returns the arguments that do not belong to ROS.
std::vector<std::string> init_and_remove_ros_arguments(int argc, char const* const* argv,
                                                       const InitOptions& init_options = InitOptions());

// The arguments without `--ros-args … [--]`.
std::vector<std::string> remove_ros_arguments(int argc, char const* const* argv);

// False before init() and after shutdown(). Null means the default context, here and below.
bool ok(Context::SharedPtr context = nullptr);

// Ends a context: executors return from spin(). Returns false if it was not valid. For the default context, also
// uninstalls the signal handlers.
bool shutdown(Context::SharedPtr context = nullptr, const std::string& reason = "user called rclcpp::shutdown()");

// Calls `callback` at the shutdown of the context, in the thread that shuts down.
void on_shutdown(std::function<void()> callback, Context::SharedPtr context = nullptr);

// Returns true after the whole time, false if the context ended first.
bool sleep_for(const std::chrono::nanoseconds& nanoseconds, Context::SharedPtr context = nullptr);

// The text as a C string, for log macros that accept both.
inline const char* get_c_string(const char* string) {
  return string;
}
inline const char* get_c_string(const std::string& string) {
  return string.c_str();
}
// The pointers are valid as long as the strings are.
inline std::vector<const char*> get_c_vector_string(const std::vector<std::string>& strings) {
  std::vector<const char*> pointers;
  for (const std::string& string : strings) {
    pointers.push_back(string.c_str());
  }
  return pointers;
}

// Whether a sum or a difference leaves the range of its type.
template <typename T>
bool add_will_overflow(const T x, const T y) {
  return y > 0 && x > std::numeric_limits<T>::max() - y;
}
template <typename T>
bool add_will_underflow(const T x, const T y) {
  return y < 0 && x < std::numeric_limits<T>::min() - y;
}
template <typename T>
bool sub_will_overflow(const T x, const T y) {
  return y < 0 && x > std::numeric_limits<T>::max() + y;
}
template <typename T>
bool sub_will_underflow(const T x, const T y) {
  return y > 0 && x < std::numeric_limits<T>::min() + y;
}

}  // namespace rclcpp
