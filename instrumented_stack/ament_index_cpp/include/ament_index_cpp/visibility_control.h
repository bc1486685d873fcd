// SPDX-License-Identifier: Apache-2.0
// The macros that mark a library's own symbols in ROS 2. Here every symbol is visible.
#pragma once

#define AMENT_INDEX_CPP_EXPORT __attribute__((visibility("default")))
#define AMENT_INDEX_CPP_IMPORT
#define AMENT_INDEX_CPP_PUBLIC __attribute__((visibility("default")))
#define AMENT_INDEX_CPP_PUBLIC_TYPE
#define AMENT_INDEX_CPP_LOCAL __attribute__((visibility("hidden")))
