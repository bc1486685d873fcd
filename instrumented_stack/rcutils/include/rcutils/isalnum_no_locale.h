// SPDX-License-Identifier: Apache-2.0
// Whether a character is a letter or a digit of ASCII, whatever the locale.
#pragma once

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rcutils_isalnum_no_locale(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

#ifdef __cplusplus
}
#endif
