// SPDX-License-Identifier: Apache-2.0
// Messages of this package and of another one in C.
#include <stdio.h>

#include "arm_driver/msg/effort.h"
#include "rcl/rcl.h"
#include "rmw/rmw.h"
#include "rosidl_runtime_c/string_functions.h"
#include "std_msgs/msg/color_rgba.h"

int main(void) {
  arm_driver__msg__Effort effort;
  rmw_serialized_message_t bytes = rmw_get_zero_initialized_serialized_message();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  std_msgs__msg__ColorRGBA* color = std_msgs__msg__ColorRGBA__create();
  if (!color || !arm_driver__msg__Effort__init(&effort) ||
      !rosidl_runtime_c__String__assign(&effort.header.frame_id, "elbow") ||
      rmw_serialized_message_init(&bytes, 0, &allocator) != RMW_RET_OK ||
      rmw_serialize(&effort, ROSIDL_GET_MSG_TYPE_SUPPORT(arm_driver, msg, Effort), &bytes) != RMW_RET_OK) {
    return 1;
  }
  printf("%s: %zu bytes\n", effort.header.frame_id.data, bytes.buffer_length);
  if (rmw_serialized_message_fini(&bytes) != RMW_RET_OK) {
    return 1;
  }
  std_msgs__msg__ColorRGBA__destroy(color);
  arm_driver__msg__Effort__fini(&effort);
  return 0;
}
