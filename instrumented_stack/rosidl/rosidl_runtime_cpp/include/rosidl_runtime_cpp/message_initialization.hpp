// SPDX-License-Identifier: Apache-2.0
#ifndef ROSIDL_RUNTIME_CPP__MESSAGE_INITIALIZATION_HPP_
#define ROSIDL_RUNTIME_CPP__MESSAGE_INITIALIZATION_HPP_

namespace rosidl_runtime_cpp {

/// What the constructor of a message sets. Strings and sequences are always valid.
enum class MessageInitialization {
  ALL,            ///< Defaults of the .msg file where it gives one, zero elsewhere.
  SKIP,           ///< Nothing: plain members hold whatever was in memory.
  ZERO,           ///< Zero, also where the .msg file gives a default.
  DEFAULTS_ONLY,  ///< Defaults where given, plain members elsewhere are left alone.
};

}  // namespace rosidl_runtime_cpp

#endif  // ROSIDL_RUNTIME_CPP__MESSAGE_INITIALIZATION_HPP_
