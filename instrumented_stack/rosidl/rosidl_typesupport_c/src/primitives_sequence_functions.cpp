// SPDX-License-Identifier: Apache-2.0
#include "rosidl_runtime_c/primitives_sequence_functions.h"

#include "rosidl_typesupport_c/element.hpp"

namespace {

using rosidl_typesupport_c::Element;

template <typename T>
constexpr Element kElement{Element::kInteger, sizeof(T), nullptr};
template <>
constexpr Element kElement<float>{Element::kFloat, sizeof(float), nullptr};
template <>
constexpr Element kElement<double>{Element::kDouble, sizeof(double), nullptr};

}  // namespace

#define DEFINE_SEQUENCE_FUNCTIONS(NAME, SEQUENCE, TYPE)                                            \
  bool rosidl_runtime_c__##NAME##__Sequence__init(SEQUENCE* sequence, size_t size) {               \
    return init_sequence(kElement<TYPE>, sequence, size);                                          \
  }                                                                                                \
  void rosidl_runtime_c__##NAME##__Sequence__fini(SEQUENCE* sequence) {                            \
    fini_sequence(kElement<TYPE>, sequence);                                                       \
  }                                                                                                \
  bool rosidl_runtime_c__##NAME##__Sequence__are_equal(const SEQUENCE* lhs, const SEQUENCE* rhs) { \
    return are_equal_sequences(kElement<TYPE>, lhs, rhs);                                          \
  }                                                                                                \
  bool rosidl_runtime_c__##NAME##__Sequence__copy(const SEQUENCE* input, SEQUENCE* output) {       \
    return copy_sequence(kElement<TYPE>, input, output);                                           \
  }

DEFINE_SEQUENCE_FUNCTIONS(float, rosidl_runtime_c__float__Sequence, float)
DEFINE_SEQUENCE_FUNCTIONS(double, rosidl_runtime_c__double__Sequence, double)
DEFINE_SEQUENCE_FUNCTIONS(long_double, rosidl_runtime_c__long_double__Sequence, long double)
DEFINE_SEQUENCE_FUNCTIONS(char, rosidl_runtime_c__char__Sequence, signed char)
DEFINE_SEQUENCE_FUNCTIONS(wchar, rosidl_runtime_c__wchar__Sequence, uint16_t)
DEFINE_SEQUENCE_FUNCTIONS(boolean, rosidl_runtime_c__boolean__Sequence, bool)
DEFINE_SEQUENCE_FUNCTIONS(octet, rosidl_runtime_c__octet__Sequence, uint8_t)
DEFINE_SEQUENCE_FUNCTIONS(uint8, rosidl_runtime_c__uint8__Sequence, uint8_t)
DEFINE_SEQUENCE_FUNCTIONS(int8, rosidl_runtime_c__int8__Sequence, int8_t)
DEFINE_SEQUENCE_FUNCTIONS(uint16, rosidl_runtime_c__uint16__Sequence, uint16_t)
DEFINE_SEQUENCE_FUNCTIONS(int16, rosidl_runtime_c__int16__Sequence, int16_t)
DEFINE_SEQUENCE_FUNCTIONS(uint32, rosidl_runtime_c__uint32__Sequence, uint32_t)
DEFINE_SEQUENCE_FUNCTIONS(int32, rosidl_runtime_c__int32__Sequence, int32_t)
DEFINE_SEQUENCE_FUNCTIONS(uint64, rosidl_runtime_c__uint64__Sequence, uint64_t)
DEFINE_SEQUENCE_FUNCTIONS(int64, rosidl_runtime_c__int64__Sequence, int64_t)

DEFINE_SEQUENCE_FUNCTIONS(bool, rosidl_runtime_c__boolean__Sequence, bool)
DEFINE_SEQUENCE_FUNCTIONS(byte, rosidl_runtime_c__octet__Sequence, uint8_t)
DEFINE_SEQUENCE_FUNCTIONS(float32, rosidl_runtime_c__float__Sequence, float)
DEFINE_SEQUENCE_FUNCTIONS(float64, rosidl_runtime_c__double__Sequence, double)
