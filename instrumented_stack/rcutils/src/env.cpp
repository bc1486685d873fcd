// SPDX-License-Identifier: Apache-2.0
#include "rcutils/env.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "rcutils/process.h"
#include "rcutils/strdup.h"

bool rcutils_set_env_overwrite(const char* env_name, const char* env_value, bool overwrite) {
  if (env_name == nullptr) {
    return false;
  }
  return (env_value == nullptr ? unsetenv(env_name) : setenv(env_name, env_value, overwrite ? 1 : 0)) == 0;
}

bool rcutils_set_env(const char* env_name, const char* env_value) {
  return rcutils_set_env_overwrite(env_name, env_value, true);
}

const char* rcutils_get_env(const char* env_name, const char** env_value) {
  if (env_name == nullptr) {
    return "argument env_name is null";
  }
  if (env_value == nullptr) {
    return "argument env_value is null";
  }
  const char* const value = getenv(env_name);
  *env_value = value == nullptr ? "" : value;
  return nullptr;
}

const char* rcutils_get_home_dir(void) {
  const char* const home = getenv("HOME");
  return home != nullptr && *home != '\0' ? home : nullptr;
}

int rcutils_get_pid(void) {
  return getpid();
}

char* rcutils_get_executable_name(rcutils_allocator_t allocator) {
  return rcutils_strdup(program_invocation_short_name, allocator);
}
