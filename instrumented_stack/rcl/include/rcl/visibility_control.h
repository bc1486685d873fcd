// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible.
#pragma once

#define RCL_EXPORT __attribute__((visibility("default")))
#define RCL_IMPORT
#define RCL_PUBLIC __attribute__((visibility("default")))
#define RCL_PUBLIC_TYPE
#define RCL_LOCAL __attribute__((visibility("hidden")))
