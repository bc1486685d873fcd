// SPDX-License-Identifier: Apache-2.0
#include "rosidl_runtime_c/u16string_functions.h"

#include "element.hpp"
#include "string_functions.hpp"

namespace {

namespace strings = rosidl_typesupport_c::strings;
using rosidl_typesupport_c::Element;

constexpr Element kWideString{Element::kWideString, sizeof(rosidl_runtime_c__U16String), nullptr};

}  // namespace

bool rosidl_runtime_c__U16String__init(rosidl_runtime_c__U16String* str) {
  return strings::init(str);
}

void rosidl_runtime_c__U16String__fini(rosidl_runtime_c__U16String* str) {
  strings::fini(str);
}

bool rosidl_runtime_c__U16String__are_equal(const rosidl_runtime_c__U16String* lhs,
                                            const rosidl_runtime_c__U16String* rhs) {
  return strings::are_equal(lhs, rhs);
}

bool rosidl_runtime_c__U16String__copy(const rosidl_runtime_c__U16String* input, rosidl_runtime_c__U16String* output) {
  return strings::copy(input, output);
}

bool rosidl_runtime_c__U16String__assignn(rosidl_runtime_c__U16String* str, const uint16_t* value, size_t n) {
  return strings::assign(str, value, n);
}

bool rosidl_runtime_c__U16String__assign(rosidl_runtime_c__U16String* str, const uint16_t* value) {
  return value != nullptr && strings::assign(str, value, rosidl_runtime_c__U16String__len(value));
}

bool rosidl_runtime_c__U16String__assignn_from_char(rosidl_runtime_c__U16String* str, const char* value, size_t n) {
  if (value == nullptr || !strings::resize(str, n)) {
    return false;
  }
  for (size_t i = 0; i < n; ++i) {
    str->data[i] = static_cast<unsigned char>(value[i]);
  }
  return true;
}

size_t rosidl_runtime_c__U16String__len(const uint16_t* value) {
  size_t length = 0;
  while (value != nullptr && value[length] != 0) {
    ++length;
  }
  return length;
}

bool rosidl_runtime_c__U16String__resize(rosidl_runtime_c__U16String* str, size_t n) {
  return strings::resize(str, n);
}

bool rosidl_runtime_c__U16String__Sequence__init(rosidl_runtime_c__U16String__Sequence* sequence, size_t size) {
  return init_sequence(kWideString, sequence, size);
}

void rosidl_runtime_c__U16String__Sequence__fini(rosidl_runtime_c__U16String__Sequence* sequence) {
  fini_sequence(kWideString, sequence);
}

bool rosidl_runtime_c__U16String__Sequence__are_equal(const rosidl_runtime_c__U16String__Sequence* lhs,
                                                      const rosidl_runtime_c__U16String__Sequence* rhs) {
  return are_equal_sequences(kWideString, lhs, rhs);
}

bool rosidl_runtime_c__U16String__Sequence__copy(const rosidl_runtime_c__U16String__Sequence* input,
                                                 rosidl_runtime_c__U16String__Sequence* output) {
  return copy_sequence(kWideString, input, output);
}

rosidl_runtime_c__U16String__Sequence* rosidl_runtime_c__U16String__Sequence__create(size_t size) {
  return static_cast<rosidl_runtime_c__U16String__Sequence*>(create_sequence(kWideString, size));
}

void rosidl_runtime_c__U16String__Sequence__destroy(rosidl_runtime_c__U16String__Sequence* sequence) {
  destroy_sequence(kWideString, sequence);
}
