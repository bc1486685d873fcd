// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rosidl_runtime_c/message_type_support_struct.h"
#include "rosidl_runtime_c/type_description.h"

namespace eprosima::fastcdr {
class Cdr;
}

// Values of `bounds_info` of message_type_support_callbacks_t::max_serialized_size.
#define ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE 0x00
// The serialised size has an upper bound.
#define ROSIDL_TYPESUPPORT_FASTRTPS_BOUNDED_TYPE 0x01
// Bounded, and the object has the same layout in memory as in CDR.
#define ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE 0x03

// Reads and writes one message type with Fast CDR. All sizes are bytes of the payload, without the four bytes of the
// encapsulation header. Alignment counts from the payload's first byte. May be called from any thread; the object must
// not change meanwhile.
typedef struct message_type_support_callbacks_t {
  // "std_msgs::msg"
  const char* message_namespace_;
  // "String"
  const char* message_name_;
  // Identifies the definition of the type: "RIHS01_" and 64 hexadecimal digits.
  const char* type_hash_;
  // Writes the message. Returns false if the buffer is too small.
  bool (*cdr_serialize)(const void* untyped_ros_message, eprosima::fastcdr::Cdr& cdr);
  // Reads into the message. Returns false if the bytes are cut short or contain a longer sequence than the type
  // allows. The message is then valid but incomplete. The bound of a string is not checked, as everywhere in ROS 2.
  bool (*cdr_deserialize)(eprosima::fastcdr::Cdr& cdr, void* untyped_ros_message);
  // The exact size that cdr_serialize would write.
  uint32_t (*get_serialized_size)(const void* untyped_ros_message);
  // The upper bound if `bounds_info` says that there is one. Otherwise the size with all unbounded parts empty.
  size_t (*max_serialized_size)(char& bounds_info);
  // Null if only the name of the type is known.
  const rosidl_type_description_t* description_;
  // Creates a message with its defaults, to be freed with destroy_message. Throws std::bad_alloc.
  void* (*create_message)(void);
  void (*destroy_message)(void* untyped_ros_message);
} message_type_support_callbacks_t;
