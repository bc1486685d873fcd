// SPDX-License-Identifier: Apache-2.0
// The text of the last error of the system.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Writes the text for errno to the buffer, shortened if it is too long. Thread safe.
void rcutils_strerror(char* buffer, size_t buffer_length);

#ifdef __cplusplus
}
#endif
