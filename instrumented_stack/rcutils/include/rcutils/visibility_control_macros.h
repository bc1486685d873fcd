// SPDX-License-Identifier: Apache-2.0
// The attributes of symbols that other libraries see.
#pragma once

#define RCUTILS_EXPORT __attribute__((visibility("default")))
#define RCUTILS_IMPORT
