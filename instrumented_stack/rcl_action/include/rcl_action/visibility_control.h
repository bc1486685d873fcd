// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible.
#pragma once

#define RCL_ACTION_EXPORT __attribute__((visibility("default")))
#define RCL_ACTION_IMPORT
#define RCL_ACTION_PUBLIC __attribute__((visibility("default")))
#define RCL_ACTION_PUBLIC_TYPE
#define RCL_ACTION_LOCAL __attribute__((visibility("hidden")))
