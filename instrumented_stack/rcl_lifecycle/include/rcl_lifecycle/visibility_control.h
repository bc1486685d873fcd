// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible.
#pragma once

#define RCL_LIFECYCLE_EXPORT __attribute__((visibility("default")))
#define RCL_LIFECYCLE_IMPORT
#define RCL_LIFECYCLE_PUBLIC __attribute__((visibility("default")))
#define RCL_LIFECYCLE_PUBLIC_TYPE
#define RCL_LIFECYCLE_LOCAL __attribute__((visibility("hidden")))
