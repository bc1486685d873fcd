// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stddef.h>

#include "rosidl_runtime_c/primitives_sequence.h"

// A string in a C message. It may contain NUL characters.
typedef struct rosidl_runtime_c__String {
  // Ends with a NUL.
  char* data;
  // The number of bytes without the final NUL.
  size_t size;
  // The number of allocated bytes.
  size_t capacity;
} rosidl_runtime_c__String;

ROSIDL_RUNTIME_C__PRIMITIVE_SEQUENCE(String, rosidl_runtime_c__String)
