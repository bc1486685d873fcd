// SPDX-License-Identifier: Apache-2.0
// Includes the headers of all types.
#pragma once

#include "rcutils/types/rcutils_ret.h"
#include "rcutils/types/string_array.h"
#include "rcutils/types/uint8_array.h"
