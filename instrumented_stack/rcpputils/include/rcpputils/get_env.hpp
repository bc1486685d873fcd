// SPDX-License-Identifier: Apache-2.0
// The former header of get_env_var().
#pragma once

#include "rcpputils/env.hpp"
