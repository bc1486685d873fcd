// SPDX-License-Identifier: Apache-2.0
// A small map from strings to strings, which it copies.
//
// RCUTILS_RET_INVALID_ARGUMENT: an argument is null. RCUTILS_RET_STRING_MAP_INVALID: the map was not initialized.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "rcutils/allocator.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcutils_string_map_impl_s;

typedef struct rcutils_string_map_s {
  struct rcutils_string_map_impl_s* impl;
} rcutils_string_map_t;

RCUTILS_WARN_UNUSED rcutils_string_map_t rcutils_get_zero_initialized_string_map(void);

// RCUTILS_RET_STRING_MAP_ALREADY_INIT if the map is in use.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_init(rcutils_string_map_t* string_map, size_t initial_capacity,
                                                          rcutils_allocator_t allocator);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_fini(rcutils_string_map_t* string_map);

RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_get_capacity(const rcutils_string_map_t* string_map,
                                                                  size_t* capacity);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_get_size(const rcutils_string_map_t* string_map, size_t* size);
// Changes the capacity, also to a smaller one, but keeps room for what is in the map.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_reserve(rcutils_string_map_t* string_map, size_t capacity);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_clear(rcutils_string_map_t* string_map);

// The first one doubles the capacity if it must; the second one then returns RCUTILS_RET_NOT_ENOUGH_SPACE.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_set(rcutils_string_map_t* string_map, const char* key,
                                                         const char* value);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_set_no_resize(rcutils_string_map_t* string_map, const char* key,
                                                                   const char* value);
// RCUTILS_RET_STRING_KEY_NOT_FOUND if the key is not there.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_unset(rcutils_string_map_t* string_map, const char* key);

bool rcutils_string_map_key_exists(const rcutils_string_map_t* string_map, const char* key);
bool rcutils_string_map_key_existsn(const rcutils_string_map_t* string_map, const char* key, size_t key_length);
// The value, or null.
const char* rcutils_string_map_get(const rcutils_string_map_t* string_map, const char* key);
const char* rcutils_string_map_getn(const rcutils_string_map_t* string_map, const char* key, size_t key_length);
// The key after `key`, which must be one that this function returned, or the first one if it is null. Null at the end.
const char* rcutils_string_map_get_next_key(const rcutils_string_map_t* string_map, const char* key);

// Adds all that is in one map to the other one.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_map_copy(const rcutils_string_map_t* src_string_map,
                                                          rcutils_string_map_t* dst_string_map);

#ifdef __cplusplus
}
#endif
