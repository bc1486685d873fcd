// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rosidl_runtime_c/primitives_sequence.h"

// A wstring in a C message: UTF-16.
typedef struct rosidl_runtime_c__U16String {
  // Ends with a 0.
  uint16_t* data;
  // The number of units without the final 0.
  size_t size;
  // The number of allocated units.
  size_t capacity;
} rosidl_runtime_c__U16String;

ROSIDL_RUNTIME_C__PRIMITIVE_SEQUENCE(U16String, rosidl_runtime_c__U16String)
