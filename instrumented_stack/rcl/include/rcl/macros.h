// SPDX-License-Identifier: Apache-2.0
// The macros of rcutils under the names of rcl.
#pragma once

#include "rcutils/macros.h"

#define RCL_WARN_UNUSED RCUTILS_WARN_UNUSED
#define RCL_UNUSED(argument) RCUTILS_UNUSED(argument)
