// SPDX-License-Identifier: Apache-2.0
#include "rosidl_runtime_c/string_functions.h"

#include "element.hpp"
#include "string_functions.hpp"

namespace {

namespace strings = rosidl_typesupport_c::strings;
using rosidl_typesupport_c::Element;

constexpr Element kString{Element::kString, sizeof(rosidl_runtime_c__String), nullptr};

}  // namespace

bool rosidl_runtime_c__String__init(rosidl_runtime_c__String* str) {
  return strings::init(str);
}

void rosidl_runtime_c__String__fini(rosidl_runtime_c__String* str) {
  strings::fini(str);
}

bool rosidl_runtime_c__String__are_equal(const rosidl_runtime_c__String* lhs, const rosidl_runtime_c__String* rhs) {
  return strings::are_equal(lhs, rhs);
}

bool rosidl_runtime_c__String__copy(const rosidl_runtime_c__String* input, rosidl_runtime_c__String* output) {
  return strings::copy(input, output);
}

bool rosidl_runtime_c__String__assignn(rosidl_runtime_c__String* str, const char* value, size_t n) {
  return strings::assign(str, value, n);
}

bool rosidl_runtime_c__String__assign(rosidl_runtime_c__String* str, const char* value) {
  return value != nullptr && strings::assign(str, value, std::strlen(value));
}

bool rosidl_runtime_c__String__resize(rosidl_runtime_c__String* str, size_t n) {
  return strings::resize(str, n);
}

bool rosidl_runtime_c__String__Sequence__init(rosidl_runtime_c__String__Sequence* sequence, size_t size) {
  return init_sequence(kString, sequence, size);
}

void rosidl_runtime_c__String__Sequence__fini(rosidl_runtime_c__String__Sequence* sequence) {
  fini_sequence(kString, sequence);
}

bool rosidl_runtime_c__String__Sequence__are_equal(const rosidl_runtime_c__String__Sequence* lhs,
                                                   const rosidl_runtime_c__String__Sequence* rhs) {
  return are_equal_sequences(kString, lhs, rhs);
}

bool rosidl_runtime_c__String__Sequence__copy(const rosidl_runtime_c__String__Sequence* input,
                                              rosidl_runtime_c__String__Sequence* output) {
  return copy_sequence(kString, input, output);
}

rosidl_runtime_c__String__Sequence* rosidl_runtime_c__String__Sequence__create(size_t size) {
  return static_cast<rosidl_runtime_c__String__Sequence*>(create_sequence(kString, size));
}

void rosidl_runtime_c__String__Sequence__destroy(rosidl_runtime_c__String__Sequence* sequence) {
  destroy_sequence(kString, sequence);
}
