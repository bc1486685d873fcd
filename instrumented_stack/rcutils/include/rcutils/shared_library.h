// SPDX-License-Identifier: Apache-2.0
// Loading libraries while a program runs.
#pragma once

#include <stdbool.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_shared_library_s {
  void* lib_pointer;
  char* library_path;
  rcutils_allocator_t allocator;
} rcutils_shared_library_t;

rcutils_shared_library_t rcutils_get_zero_initialized_shared_library(void);

// The path is absolute, or a name that the loader of the system finds. Returns RCUTILS_RET_INVALID_ARGUMENT for null
// and for a library that is loaded already, RCUTILS_RET_ERROR with the loader's message if it cannot be loaded.
rcutils_ret_t rcutils_load_shared_library(rcutils_shared_library_t* lib, const char* library_path,
                                          rcutils_allocator_t allocator);
// Null, with an error message, if there is no such symbol.
void* rcutils_get_symbol(const rcutils_shared_library_t* lib, const char* symbol_name);
bool rcutils_has_symbol(const rcutils_shared_library_t* lib, const char* symbol_name);
rcutils_ret_t rcutils_unload_shared_library(rcutils_shared_library_t* lib);
bool rcutils_is_shared_library_loaded(rcutils_shared_library_t* lib);

// "x" becomes "libx.so", with `debug` "libxd.so".
rcutils_ret_t rcutils_get_platform_library_name(const char* library_name, char* library_name_platform,
                                                unsigned int buffer_size, bool debug);

#ifdef __cplusplus
}
#endif
