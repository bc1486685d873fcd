// The former place of get_env_var().
#pragma once

#include "rcpputils/env.hpp"
