// SPDX-License-Identifier: Apache-2.0
// Options of a command line, looked up one by one.
#pragma once

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Whether `option` is one of the words in [begin, end).
bool rcutils_cli_option_exist(char** begin, char** end, const char* option);

// The word after `option`; null if there is none.
char* rcutils_cli_get_option(char** begin, char** end, const char* option);

#ifdef __cplusplus
}
#endif
