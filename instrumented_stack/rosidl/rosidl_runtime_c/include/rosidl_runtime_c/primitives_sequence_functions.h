// SPDX-License-Identifier: Apache-2.0
// The functions of sequences of primitives, for example rosidl_runtime_c__int32__Sequence__init. They are in the
// library rosidl_typesupport_c, which all C messages link.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rosidl_runtime_c/primitives_sequence.h"
#include "rosidl_runtime_c/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

// init       allocates `size` elements of 0; false for a null pointer, or if memory runs out
// fini       frees them; the sequence is then empty, and may be finalised again
// are_equal  false also for a null pointer
// copy       the output must be initialised; false for a null pointer, or if memory runs out
#define ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(NAME, SEQUENCE)                              \
  bool rosidl_runtime_c__##NAME##__Sequence__init(SEQUENCE* sequence, size_t size);               \
  void rosidl_runtime_c__##NAME##__Sequence__fini(SEQUENCE* sequence);                            \
  bool rosidl_runtime_c__##NAME##__Sequence__are_equal(const SEQUENCE* lhs, const SEQUENCE* rhs); \
  bool rosidl_runtime_c__##NAME##__Sequence__copy(const SEQUENCE* input, SEQUENCE* output);

#define ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(STRUCT_NAME) \
  ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(STRUCT_NAME, rosidl_runtime_c__##STRUCT_NAME##__Sequence)

ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(float)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(double)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(long_double)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(char)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(wchar)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(boolean)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(octet)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint8)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int8)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint16)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int16)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint32)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int32)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(uint64)
ROSIDL_RUNTIME_C__DECLARE_PRIMITIVE_SEQUENCE_FUNCTIONS(int64)

// The names of .msg files for the same sequences.
ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(bool, rosidl_runtime_c__boolean__Sequence)
ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(byte, rosidl_runtime_c__octet__Sequence)
ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(float32, rosidl_runtime_c__float__Sequence)
ROSIDL_RUNTIME_C__DECLARE_SEQUENCE_FUNCTIONS(float64, rosidl_runtime_c__double__Sequence)

#ifdef __cplusplus
}
#endif
