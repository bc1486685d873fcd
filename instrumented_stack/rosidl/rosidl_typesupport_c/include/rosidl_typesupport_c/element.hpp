// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rosidl_typesupport_c/message_layout.h"

// One element of a field of a C message, and the field itself: the element, an array, or a sequence.
namespace rosidl_typesupport_c {

using Layout = rosidl_typesupport_c__MessageLayout;

// What an element is. The values of primitives do not matter, except where they are compared or converted.
struct Element {
  enum Kind : std::uint8_t { kBool, kInteger, kFloat, kDouble, kString, kWideString, kMessage };

  Kind kind;
  std::size_t size;       // in memory
  const Layout* message;  // of a message, else null

  [[nodiscard]] bool is_primitive() const { return kind <= kDouble; }
};

struct Field {
  enum Shape : std::uint8_t { kOne, kArray, kBoundedSequence, kSequence };

  Element element;
  Shape shape;
  std::size_t offset;
  std::size_t count;         // of an array; 1 if it is one element; the bound of a bounded sequence, or 0
  std::size_t string_bound;  // or 0

  [[nodiscard]] bool is_sequence() const { return shape >= kBoundedSequence; }
};

Field field_of(const Layout& layout, std::size_t index);

// All structures <type>__Sequence have these members. They are copied, because their types differ.
struct Sequence {
  void* data;
  std::size_t size;
  std::size_t capacity;
};

Sequence load(const void* sequence);
void store(void* sequence, const Sequence& value);

// The following functions handle `count` elements, one after the other. Memory is initialised by 0 before `init`.
bool init(const Element& element, void* elements, std::size_t count);
void fini(const Element& element, void* elements, std::size_t count);
bool are_equal(const Element& element, const void* lhs, const void* rhs, std::size_t count);
bool copy(const Element& element, const void* input, void* output, std::size_t count);

// All elements up to the capacity of a sequence are initialised. `resize` makes more if there are less than `size`.
bool resize(const Element& element, void* sequence, std::size_t size);
bool init_sequence(const Element& element, void* sequence, std::size_t size);
void fini_sequence(const Element& element, void* sequence);
void* create_sequence(const Element& element, std::size_t size);
void destroy_sequence(const Element& element, void* sequence);
bool are_equal_sequences(const Element& element, const void* lhs, const void* rhs);
bool copy_sequence(const Element& element, const void* input, void* output);

inline void* at(const Element& element, void* elements, std::size_t index) {
  return static_cast<char*>(elements) + index * element.size;
}
inline const void* at(const Element& element, const void* elements, std::size_t index) {
  return static_cast<const char*>(elements) + index * element.size;
}
inline void* member(void* message, std::size_t offset) {
  return static_cast<char*>(message) + offset;
}
inline const void* member(const void* message, std::size_t offset) {
  return static_cast<const char*>(message) + offset;
}

}  // namespace rosidl_typesupport_c
