// SPDX-License-Identifier: Apache-2.0
// Every action that launch files can use.
#pragma once

#include "launcher/core/registry.hpp"

namespace launch {

Registry builtin_actions();

}  // namespace launch
