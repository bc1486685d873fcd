// SPDX-License-Identifier: Apache-2.0
// All functions of rosidl_runtime_c are visible.
#pragma once

#define ROSIDL_GENERATOR_C_EXPORT
#define ROSIDL_GENERATOR_C_IMPORT
#define ROSIDL_GENERATOR_C_PUBLIC
#define ROSIDL_GENERATOR_C_LOCAL
