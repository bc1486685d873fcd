// SPDX-License-Identifier: Apache-2.0
#include "rcutils/shared_library.h"

#include <dlfcn.h>
#include <stdio.h>

#include "rcutils/error_handling.h"
#include "rcutils/strdup.h"

rcutils_shared_library_t rcutils_get_zero_initialized_shared_library(void) {
  return {nullptr, nullptr, rcutils_get_zero_initialized_allocator()};
}

rcutils_ret_t rcutils_load_shared_library(rcutils_shared_library_t* lib, const char* library_path,
                                          rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(lib, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(library_path, RCUTILS_RET_INVALID_ARGUMENT);
  if (!rcutils_allocator_is_valid(&allocator) || lib->lib_pointer != nullptr) {
    RCUTILS_SET_ERROR_MSG("no valid allocator, or the library is loaded already");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  lib->lib_pointer = dlopen(library_path, RTLD_LAZY);
  if (lib->lib_pointer == nullptr) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("dlopen error: %s", dlerror());
    return RCUTILS_RET_ERROR;
  }
  lib->allocator = allocator;
  lib->library_path = rcutils_strdup(library_path, allocator);
  return RCUTILS_RET_OK;
}

void* rcutils_get_symbol(const rcutils_shared_library_t* lib, const char* symbol_name) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(lib, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(lib->lib_pointer, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(symbol_name, nullptr);
  void* const symbol = dlsym(lib->lib_pointer, symbol_name);
  if (symbol == nullptr) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("symbol '%s' does not exist in the library '%s'", symbol_name,
                                             lib->library_path);
  }
  return symbol;
}

bool rcutils_has_symbol(const rcutils_shared_library_t* lib, const char* symbol_name) {
  return lib != nullptr && lib->lib_pointer != nullptr && symbol_name != nullptr &&
         dlsym(lib->lib_pointer, symbol_name) != nullptr;
}

rcutils_ret_t rcutils_unload_shared_library(rcutils_shared_library_t* lib) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(lib, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(lib->lib_pointer, RCUTILS_RET_INVALID_ARGUMENT);
  const bool closed = dlclose(lib->lib_pointer) == 0;
  if (lib->library_path != nullptr) {
    lib->allocator.deallocate(lib->library_path, lib->allocator.state);
  }
  *lib = rcutils_get_zero_initialized_shared_library();
  if (!closed) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("dlclose error: %s", dlerror());
    return RCUTILS_RET_ERROR;
  }
  return RCUTILS_RET_OK;
}

bool rcutils_is_shared_library_loaded(rcutils_shared_library_t* lib) {
  return lib != nullptr && lib->lib_pointer != nullptr;
}

rcutils_ret_t rcutils_get_platform_library_name(const char* library_name, char* library_name_platform,
                                                unsigned int buffer_size, bool debug) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(library_name, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(library_name_platform, RCUTILS_RET_INVALID_ARGUMENT);
  const int length = snprintf(library_name_platform, buffer_size, debug ? "lib%sd.so" : "lib%s.so", library_name);
  return length >= 0 && static_cast<unsigned int>(length) < buffer_size ? RCUTILS_RET_OK : RCUTILS_RET_ERROR;
}
