// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

// The functions of rosidl_runtime_c__String and rosidl_runtime_c__U16String, which differ in the type of a unit.
namespace rosidl_typesupport_c::strings {

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

}  // namespace rosidl_typesupport_c::strings
