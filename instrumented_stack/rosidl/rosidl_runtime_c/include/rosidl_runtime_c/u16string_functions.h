// SPDX-License-Identifier: Apache-2.0
// The functions of wstrings in C messages. They are in the library rosidl_typesupport_c, which all C messages link.
//
// A function that returns bool returns false for a null pointer, or if memory runs out. The target is then unchanged.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rosidl_runtime_c/u16string.h"
#include "rosidl_runtime_c/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

// Makes an empty string. Its memory may be uninitialised before.
bool rosidl_runtime_c__U16String__init(rosidl_runtime_c__U16String* str);
// Frees the string. It may be finalised again.
void rosidl_runtime_c__U16String__fini(rosidl_runtime_c__U16String* str);
bool rosidl_runtime_c__U16String__are_equal(const rosidl_runtime_c__U16String* lhs,
                                            const rosidl_runtime_c__U16String* rhs);
// The output must be initialised, as for all functions that follow.
bool rosidl_runtime_c__U16String__copy(const rosidl_runtime_c__U16String* input, rosidl_runtime_c__U16String* output);
// Copies `n` units and adds a 0.
bool rosidl_runtime_c__U16String__assignn(rosidl_runtime_c__U16String* str, const uint16_t* value, size_t n);
// Copies up to the first 0.
bool rosidl_runtime_c__U16String__assign(rosidl_runtime_c__U16String* str, const uint16_t* value);
// Copies `n` characters of ASCII.
bool rosidl_runtime_c__U16String__assignn_from_char(rosidl_runtime_c__U16String* str, const char* value, size_t n);
// The number of units before the first 0.
size_t rosidl_runtime_c__U16String__len(const uint16_t* value);
// The units beyond the old size are not set.
bool rosidl_runtime_c__U16String__resize(rosidl_runtime_c__U16String* str, size_t n);

bool rosidl_runtime_c__U16String__Sequence__init(rosidl_runtime_c__U16String__Sequence* sequence, size_t size);
void rosidl_runtime_c__U16String__Sequence__fini(rosidl_runtime_c__U16String__Sequence* sequence);
bool rosidl_runtime_c__U16String__Sequence__are_equal(const rosidl_runtime_c__U16String__Sequence* lhs,
                                                      const rosidl_runtime_c__U16String__Sequence* rhs);
bool rosidl_runtime_c__U16String__Sequence__copy(const rosidl_runtime_c__U16String__Sequence* input,
                                                 rosidl_runtime_c__U16String__Sequence* output);
// Returns null if memory runs out. Free the sequence with destroy.
rosidl_runtime_c__U16String__Sequence* rosidl_runtime_c__U16String__Sequence__create(size_t size);
void rosidl_runtime_c__U16String__Sequence__destroy(rosidl_runtime_c__U16String__Sequence* sequence);

#ifdef __cplusplus
}
#endif
