// SPDX-License-Identifier: Apache-2.0
// Environment variables. Not thread safe if another thread changes them.
#pragma once

#include <rcutils/env.h>

#include <stdexcept>
#include <string>

namespace rcpputils {

// Empty if the variable is not set. Throws std::runtime_error for a null name.
inline std::string get_env_var(const char* env_var) {
  const char* value = nullptr;
  if (const char* error = rcutils_get_env(env_var, &value)) {
    throw std::runtime_error(error);
  }
  return value;
}

// A null value unsets the variable. Returns true, or throws std::runtime_error if the name is null, empty or contains
// '='.
inline bool set_env_var(const char* env_var, const char* value) {
  if (!rcutils_set_env(env_var, value)) {
    throw std::runtime_error("failed to set an environment variable");
  }
  return true;
}

}  // namespace rcpputils
