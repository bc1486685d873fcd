// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rosidl_runtime_cpp {

// Selects the members that the constructor of a message sets. Strings and sequences are always valid.
enum class MessageInitialization {
  ALL,            // Defaults of the .msg file where it has them, zero elsewhere.
  SKIP,           // Nothing: plain members are uninitialised.
  ZERO,           // Zero, even where the .msg file has a default.
  DEFAULTS_ONLY,  // Defaults where they exist; other plain members are not set.
};

}  // namespace rosidl_runtime_cpp
