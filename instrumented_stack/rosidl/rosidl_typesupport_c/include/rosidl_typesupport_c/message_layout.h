// SPDX-License-Identifier: Apache-2.0
// Where the fields of a C message are, and functions that work for all C messages because they know this. Generated
// code has a layout for each message; its functions, such as std_msgs__msg__String__init, call these. `message` is a
// pointer to the structure of the message, `sequence` to a structure <message>__Sequence.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rosidl_runtime_c/type_description.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rosidl_typesupport_c__MessageLayout rosidl_typesupport_c__MessageLayout;

struct rosidl_typesupport_c__MessageLayout {
  // The types and names of the fields.
  const rosidl_type_description_t* description;
  // The size of the structure.
  size_t size;
  // The least number of bytes of the message in CDR.
  size_t least_cdr_size;
  // Of each field in the structure.
  const size_t* offsets;
  // The layout of each field that is a message; null for the other fields.
  const rosidl_typesupport_c__MessageLayout* const* nested;
  // Gives fields their defaults in a message that is initialised otherwise. False if memory runs out. Null if no field
  // has a default.
  bool (*set_defaults)(void* message);
};

// These functions return false or null for a null pointer, or if memory runs out. A message that could not be
// initialised needs no fini. The output of a copy must be initialised; if the copy fails, it is valid but incomplete.
bool rosidl_typesupport_c__message_init(const rosidl_typesupport_c__MessageLayout* layout, void* message);
void rosidl_typesupport_c__message_fini(const rosidl_typesupport_c__MessageLayout* layout, void* message);
void* rosidl_typesupport_c__message_create(const rosidl_typesupport_c__MessageLayout* layout);
void rosidl_typesupport_c__message_destroy(const rosidl_typesupport_c__MessageLayout* layout, void* message);
bool rosidl_typesupport_c__message_are_equal(const rosidl_typesupport_c__MessageLayout* layout, const void* lhs,
                                             const void* rhs);
bool rosidl_typesupport_c__message_copy(const rosidl_typesupport_c__MessageLayout* layout, const void* input,
                                        void* output);

bool rosidl_typesupport_c__sequence_init(const rosidl_typesupport_c__MessageLayout* layout, void* sequence,
                                         size_t size);
void rosidl_typesupport_c__sequence_fini(const rosidl_typesupport_c__MessageLayout* layout, void* sequence);
void* rosidl_typesupport_c__sequence_create(const rosidl_typesupport_c__MessageLayout* layout, size_t size);
void rosidl_typesupport_c__sequence_destroy(const rosidl_typesupport_c__MessageLayout* layout, void* sequence);
bool rosidl_typesupport_c__sequence_are_equal(const rosidl_typesupport_c__MessageLayout* layout, const void* lhs,
                                              const void* rhs);
bool rosidl_typesupport_c__sequence_copy(const rosidl_typesupport_c__MessageLayout* layout, const void* input,
                                         void* output);

#ifdef __cplusplus
}
#endif
