// SPDX-License-Identifier: Apache-2.0
// The allocator of the functions of this layer.
#pragma once

#include "rcutils/allocator.h"

typedef rcutils_allocator_t rcl_allocator_t;

#define rcl_get_default_allocator rcutils_get_default_allocator
