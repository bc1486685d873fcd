// SPDX-License-Identifier: Apache-2.0
// The former header of rcutils_get_env().
#pragma once

#include "rcutils/env.h"
