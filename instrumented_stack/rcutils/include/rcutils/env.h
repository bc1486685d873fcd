// SPDX-License-Identifier: Apache-2.0
// Environment variables. Not thread safe against others that change them.
#pragma once

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Null unsets. False for an empty name or one with '='.
bool rcutils_set_env(const char* env_name, const char* env_value);
bool rcutils_set_env_overwrite(const char* env_name, const char* env_value, bool overwrite);

// *env_value is what the variable holds, "" when it is not set; it belongs to the environment. An error message, or
// null.
const char* rcutils_get_env(const char* env_name, const char** env_value);

// The user's home directory, null when it is not known.
const char* rcutils_get_home_dir(void);

#ifdef __cplusplus
}
#endif
