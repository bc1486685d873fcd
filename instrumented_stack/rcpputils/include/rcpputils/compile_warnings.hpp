// SPDX-License-Identifier: Apache-2.0
// Uses of what is deprecated, without the compiler's warning.
#pragma once

// Between these two, deprecated names may be used.
#define RCPPUTILS_DEPRECATION_WARNING_OFF_START \
  _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wdeprecated-declarations\"")
#define RCPPUTILS_DEPRECATION_WARNING_OFF_STOP _Pragma("GCC diagnostic pop")
