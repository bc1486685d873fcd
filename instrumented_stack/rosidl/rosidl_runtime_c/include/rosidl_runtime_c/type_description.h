// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_type_description_t rosidl_type_description_t;

// One field of an interface. All strings of descriptions are UTF-8 and never null.
typedef struct rosidl_field_description_t {
  const char* name;
  // One of the constants of type_description_interfaces/msg/FieldType.
  uint8_t type_id;
  // The number of elements of an array, the bound of a bounded sequence, otherwise 0.
  uint64_t capacity;
  // The maximum length of a bounded string, otherwise 0.
  uint64_t string_capacity;
  // Set if the field, or its elements, are themselves interfaces; else null.
  const rosidl_type_description_t* nested_type;
  // Empty if there is no default.
  const char* default_value;
} rosidl_field_description_t;

// A message, service or action as its file defines it. It lives as long as the package's library (static storage
// duration).
struct rosidl_type_description_t {
  // "std_msgs/msg/Header"
  const char* type_name;
  // Identifies the definition: "RIHS01_" and 64 hexadecimal digits.
  const char* type_hash;
  const rosidl_field_description_t* fields;
  size_t field_count;
  // "msg", "srv" or "action"; "implicit" for a part of another interface.
  const char* encoding;
  // The text of the file; empty if it is implicit.
  const char* source;
};

#ifdef __cplusplus
}
#endif
