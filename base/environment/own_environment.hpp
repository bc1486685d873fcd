// SPDX-License-Identifier: Apache-2.0
// The environment that this process was started with.
#pragma once

#include "base/environment/environment.hpp"

namespace launch {

// A copy of the variables as they are now. When a name appears twice, the first entry counts, as for getenv(3); an
// entry without "=" is skipped. No other thread may change the environment meanwhile.
Environment own_environment();

}  // namespace launch
