// SPDX-License-Identifier: Apache-2.0
// The former place of rcutils_get_env().
#pragma once

#include "rcutils/env.h"
