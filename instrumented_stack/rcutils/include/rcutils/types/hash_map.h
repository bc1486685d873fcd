// SPDX-License-Identifier: Apache-2.0
// A map from keys of one size to values of one size, both of which it copies.
//
// The map asks the two functions of the program for the hash of a key, and for 0 if two keys are equal.
// RCUTILS_RET_INVALID_ARGUMENT: an argument is null. RCUTILS_RET_NOT_INITIALIZED: the map was not initialized.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "rcutils/allocator.h"
#include "rcutils/error_handling.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcutils_hash_map_impl_s;

typedef struct rcutils_hash_map_s {
  struct rcutils_hash_map_impl_s* impl;
} rcutils_hash_map_t;

typedef size_t (*rcutils_hash_map_key_hasher_t)(const void* key);
typedef int (*rcutils_hash_map_key_cmp_t)(const void* val1, const void* val2);

#define HASH_MAP_VALIDATE_HASH_MAP(map)                               \
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(map, RCUTILS_RET_INVALID_ARGUMENT); \
  if ((map)->impl == NULL) {                                          \
    RCUTILS_SET_ERROR_MSG("map is not initialized");                  \
    return RCUTILS_RET_NOT_INITIALIZED;                               \
  }

// For keys of the type `const char*`.
size_t rcutils_hash_map_string_hash_func(const void* key_str);
int rcutils_hash_map_string_cmp_func(const void* val1, const void* val2);

RCUTILS_WARN_UNUSED rcutils_hash_map_t rcutils_get_zero_initialized_hash_map(void);

// The capacity becomes the next power of two. It doubles when three quarters of it are in use.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_init(rcutils_hash_map_t* hash_map, size_t initial_capacity,
                                                        size_t key_size, size_t data_size,
                                                        rcutils_hash_map_key_hasher_t key_hashing_func,
                                                        rcutils_hash_map_key_cmp_t key_cmp_func,
                                                        const rcutils_allocator_t* allocator);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_fini(rcutils_hash_map_t* hash_map);

RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_get_capacity(const rcutils_hash_map_t* hash_map, size_t* capacity);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_get_size(const rcutils_hash_map_t* hash_map, size_t* size);

RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_set(rcutils_hash_map_t* hash_map, const void* key,
                                                       const void* value);
// OK also if the key is not there.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_hash_map_unset(rcutils_hash_map_t* hash_map, const void* key);
bool rcutils_hash_map_key_exists(const rcutils_hash_map_t* hash_map, const void* key);
// RCUTILS_RET_NOT_FOUND if the key is not there.
rcutils_ret_t rcutils_hash_map_get(const rcutils_hash_map_t* hash_map, const void* key, void* data);

// Copies the pair after `previous_key`, or the first one if it is null. RCUTILS_RET_HASH_MAP_NO_MORE_ENTRIES after the
// last one. A change of the map begins another order.
rcutils_ret_t rcutils_hash_map_get_next_key_and_data(const rcutils_hash_map_t* hash_map, const void* previous_key,
                                                     void* key, void* data);

#ifdef __cplusplus
}
#endif
