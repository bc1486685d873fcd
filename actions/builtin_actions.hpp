// SPDX-License-Identifier: Apache-2.0
// Every action that launch files can use.
#pragma once

#include "launcher/language/registry.hpp"

namespace launch {

Registry builtin_actions();

}  // namespace launch
