// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stddef.h>

// The maximum length of a string.
typedef struct rosidl_runtime_c__String__bound {
  size_t bound;
} rosidl_runtime_c__String__bound;
