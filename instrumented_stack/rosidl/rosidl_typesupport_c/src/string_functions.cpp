// SPDX-License-Identifier: Apache-2.0
// The functions of rosidl_runtime_c__String and rosidl_runtime_c__U16String, which differ in the type of a unit.
#include "rosidl_runtime_c/string_functions.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "rosidl_runtime_c/u16string_functions.h"
#include "rosidl_typesupport_c/element.hpp"

namespace {
namespace strings {

template <typename String>
bool resize(String* text, std::size_t size) {
  if (text == nullptr || size >= SIZE_MAX / sizeof *text->data) {
    return false;
  }
  void* data = std::realloc(text->data, (size + 1) * sizeof *text->data);
  if (data == nullptr) {
    return false;
  }
  text->data = static_cast<decltype(text->data)>(data);
  text->data[size] = 0;
  text->size = size;
  text->capacity = size + 1;
  return true;
}

template <typename String>
bool init(String* text) {
  if (text == nullptr) {
    return false;
  }
  *text = {nullptr, 0, 0};
  return resize(text, 0);
}

template <typename String>
void fini(String* text) {
  if (text != nullptr) {
    std::free(text->data);
    *text = {nullptr, 0, 0};
  }
}

template <typename String>
bool are_equal(const String* lhs, const String* rhs) {
  return lhs != nullptr && rhs != nullptr && lhs->size == rhs->size &&
         (lhs->size == 0 || std::memcmp(lhs->data, rhs->data, lhs->size * sizeof *lhs->data) == 0);
}

template <typename String, typename Unit>
bool assign(String* text, const Unit* value, std::size_t size) {
  if (text == nullptr || value == nullptr) {
    return false;
  }
  if (value == text->data) {
    return size <= text->size && resize(text, size);
  }
  if (!resize(text, size)) {
    return false;
  }
  std::memcpy(text->data, value, size * sizeof *value);
  return true;
}

template <typename String>
bool copy(const String* input, String* output) {
  return input != nullptr && assign(output, input->data, input->size);
}

}  // namespace strings

using rosidl_typesupport_c::Element;

constexpr Element kString{Element::kString, sizeof(rosidl_runtime_c__String), nullptr};
constexpr Element kWideString{Element::kWideString, sizeof(rosidl_runtime_c__U16String), nullptr};

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
