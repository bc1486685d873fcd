// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible.
#pragma once

#define CLASS_LOADER_EXPORT __attribute__((visibility("default")))
#define CLASS_LOADER_IMPORT
#define CLASS_LOADER_PUBLIC __attribute__((visibility("default")))
#define CLASS_LOADER_PUBLIC_TYPE
#define CLASS_LOADER_LOCAL __attribute__((visibility("hidden")))
