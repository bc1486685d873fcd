// SPDX-License-Identifier: Apache-2.0
#pragma once

// The ways to initialise a message in C++. The functions for C messages always initialise all fields.
enum rosidl_runtime_c__message_initialization {
  // Fields with a default have it, the others are 0 or empty.
  ROSIDL_RUNTIME_C_MSG_INIT_ALL,
  ROSIDL_RUNTIME_C_MSG_INIT_SKIP,
  ROSIDL_RUNTIME_C_MSG_INIT_ZERO,
  // Fields without a default are left as they are.
  ROSIDL_RUNTIME_C_MSG_INIT_DEFAULTS_ONLY,
};
