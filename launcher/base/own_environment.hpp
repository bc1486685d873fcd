// SPDX-License-Identifier: Apache-2.0
// The environment that this process was started with.
#pragma once

#include "launcher/base/environment.hpp"

namespace launch {

// A copy of the variables as they are now. Of a name that stands twice the first one counts, as for getenv(3); a text
// without "=" is no variable. No other thread may change the environment meanwhile.
Environment own_environment();

}  // namespace launch
