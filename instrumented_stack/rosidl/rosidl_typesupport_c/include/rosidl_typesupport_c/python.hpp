// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_typesupport_c/message_layout.h"
#include "rosidl_typesupport_fastrtps_cpp/message_type_support.h"

// What the classes of Python need of a C message. The conversions are in the extension module of rosidl_generator_py.
namespace rosidl_typesupport_c {

using Layout = rosidl_typesupport_c__MessageLayout;

// What the handle of a C message points to.
struct MessageSupport {
  message_type_support_callbacks_t callbacks;  // first, because it is what the middleware knows
  const Layout* layout;
  // Makes an object of Python of the message: a new reference, or null and an exception. rclpy calls it without any
  // argument that tells the type, so each type has its own.
  void* (*to_python)(void* message);
};

// The content of a handle that a function rosidl_typesupport_c__get_message_type_support_handle__… has returned.
inline const MessageSupport& message_support(const rosidl_message_type_support_t& handle) {
  return *static_cast<const MessageSupport*>(handle.data);
}

// What all `to_python` call. The extension module sets it, which holds Python's lock then, as all callers do.
using ToPython = void* (*)(const Layout& layout, void* message);
void set_to_python(ToPython function);
void* to_python(const Layout& layout, void* message);

}  // namespace rosidl_typesupport_c
