// SPDX-License-Identifier: Apache-2.0
// Environment variables. Not thread safe if another thread changes them.
#pragma once

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// A null value unsets the variable. Returns false if the name is empty or contains '='.
bool rcutils_set_env(const char* env_name, const char* env_value);
bool rcutils_set_env_overwrite(const char* env_name, const char* env_value, bool overwrite);

// Sets *env_value to the variable's value, "" if it is not set. The value belongs to the environment. Returns an error
// message, or null.
const char* rcutils_get_env(const char* env_name, const char** env_value);

// The user's home directory; null if it is not known.
const char* rcutils_get_home_dir(void);

#ifdef __cplusplus
}
#endif
