// The former place of rcutils_get_env().
#pragma once

#include "rcutils/env.h"
