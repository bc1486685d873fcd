// SPDX-License-Identifier: Apache-2.0
// The hash of a type's description. Equal hashes mean that two sides use the same definition.
#pragma once

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

#define ROSIDL_TYPE_HASH_VERSION_UNSET 0
#define ROSIDL_TYPE_HASH_SIZE 32

// All zero if it is not known.
typedef struct rosidl_type_hash_s {
  uint8_t version;
  uint8_t value[ROSIDL_TYPE_HASH_SIZE];  // SHA-256
} rosidl_type_hash_t;

static inline rosidl_type_hash_t rosidl_get_zero_initialized_type_hash(void) {
  rosidl_type_hash_t hash;
  memset(&hash, 0, sizeof hash);
  return hash;
}

// Returns `RIHS01_` and 64 hexadecimal digits. Free the output with `allocator`. Returns RCUTILS_RET_INVALID_ARGUMENT
// for a null pointer, or RCUTILS_RET_BAD_ALLOC.
static inline rcutils_ret_t rosidl_stringify_type_hash(const rosidl_type_hash_t* type_hash,
                                                       rcutils_allocator_t allocator, char** output_string) {
  const size_t prefix_length = 7;
  const size_t length = prefix_length + 2 * ROSIDL_TYPE_HASH_SIZE;
  char* text;
  if (!type_hash || !output_string) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  text = (char*)allocator.allocate(length + 1, allocator.state);
  if (!text) {
    return RCUTILS_RET_BAD_ALLOC;
  }
  snprintf(text, length + 1, "RIHS%02x_", (unsigned)type_hash->version);
  for (size_t i = 0; i < ROSIDL_TYPE_HASH_SIZE; ++i) {
    snprintf(text + prefix_length + 2 * i, 3, "%02x", (unsigned)type_hash->value[i]);
  }
  *output_string = text;
  return RCUTILS_RET_OK;
}

// The inverse function. For a text that is not such a hash, returns RCUTILS_RET_INVALID_ARGUMENT and a zero hash.
static inline rcutils_ret_t rosidl_parse_type_hash_string(const char* type_hash_string, rosidl_type_hash_t* hash_out) {
  const size_t prefix_length = 7;
  unsigned version;
  int end = 0;
  if (!type_hash_string || !hash_out) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  *hash_out = rosidl_get_zero_initialized_type_hash();
  if (strlen(type_hash_string) != prefix_length + 2 * ROSIDL_TYPE_HASH_SIZE ||
      strspn(type_hash_string + prefix_length, "0123456789abcdefABCDEF") != 2 * ROSIDL_TYPE_HASH_SIZE ||
      sscanf(type_hash_string, "RIHS%2x_%n", &version, &end) != 1 || end != (int)prefix_length) {
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  hash_out->version = (uint8_t)version;
  for (size_t i = 0; i < ROSIDL_TYPE_HASH_SIZE; ++i) {
    unsigned byte = 0;
    (void)sscanf(type_hash_string + prefix_length + 2 * i, "%2x", &byte);
    hash_out->value[i] = (uint8_t)byte;
  }
  return RCUTILS_RET_OK;
}

#ifdef __cplusplus
}
#endif
