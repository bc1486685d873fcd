// SPDX-License-Identifier: Apache-2.0
#include "rosidl_typesupport_c/message_layout.h"

#include <cstdlib>
#include <cstring>

#include "rosidl_typesupport_c/element.hpp"

using rosidl_typesupport_c::Element;
using rosidl_typesupport_c::Field;
using rosidl_typesupport_c::field_of;
using rosidl_typesupport_c::Layout;
using rosidl_typesupport_c::member;

namespace {

Element message_element(const Layout* layout) {
  return {Element::kMessage, layout->size, layout};
}

}  // namespace

bool rosidl_typesupport_c__message_init(const Layout* layout, void* message) {
  if (message == nullptr) {
    return false;
  }
  std::memset(message, 0, layout->size);
  bool complete = true;
  for (std::size_t i = 0; complete && i < layout->description->field_count; ++i) {
    const Field field = field_of(*layout, i);
    complete = field.is_sequence() || init(field.element, member(message, field.offset), field.count);
  }
  if (complete && layout->set_defaults != nullptr) {
    complete = layout->set_defaults(message);
  }
  if (!complete) {
    // Fields that were not reached are 0, which is fine to finalise.
    rosidl_typesupport_c__message_fini(layout, message);
  }
  return complete;
}

void rosidl_typesupport_c__message_fini(const Layout* layout, void* message) {
  if (message == nullptr) {
    return;
  }
  for (std::size_t i = 0; i < layout->description->field_count; ++i) {
    const Field field = field_of(*layout, i);
    if (field.is_sequence()) {
      fini_sequence(field.element, member(message, field.offset));
    } else {
      fini(field.element, member(message, field.offset), field.count);
    }
  }
}

void* rosidl_typesupport_c__message_create(const Layout* layout) {
  void* message = std::malloc(layout->size);
  if (message != nullptr && !rosidl_typesupport_c__message_init(layout, message)) {
    std::free(message);
    return nullptr;
  }
  return message;
}

void rosidl_typesupport_c__message_destroy(const Layout* layout, void* message) {
  rosidl_typesupport_c__message_fini(layout, message);
  std::free(message);
}

bool rosidl_typesupport_c__message_are_equal(const Layout* layout, const void* lhs, const void* rhs) {
  if (lhs == nullptr || rhs == nullptr) {
    return false;
  }
  for (std::size_t i = 0; i < layout->description->field_count; ++i) {
    const Field field = field_of(*layout, i);
    const void* one = member(lhs, field.offset);
    const void* other = member(rhs, field.offset);
    if (!(field.is_sequence() ? are_equal_sequences(field.element, one, other)
                              : are_equal(field.element, one, other, field.count))) {
      return false;
    }
  }
  return true;
}

bool rosidl_typesupport_c__message_copy(const Layout* layout, const void* input, void* output) {
  if (input == nullptr || output == nullptr) {
    return false;
  }
  for (std::size_t i = 0; i < layout->description->field_count; ++i) {
    const Field field = field_of(*layout, i);
    const void* from = member(input, field.offset);
    void* to = member(output, field.offset);
    if (!(field.is_sequence() ? copy_sequence(field.element, from, to) : copy(field.element, from, to, field.count))) {
      return false;
    }
  }
  return true;
}

bool rosidl_typesupport_c__sequence_init(const Layout* layout, void* sequence, std::size_t size) {
  return init_sequence(message_element(layout), sequence, size);
}

void rosidl_typesupport_c__sequence_fini(const Layout* layout, void* sequence) {
  fini_sequence(message_element(layout), sequence);
}

void* rosidl_typesupport_c__sequence_create(const Layout* layout, std::size_t size) {
  return create_sequence(message_element(layout), size);
}

void rosidl_typesupport_c__sequence_destroy(const Layout* layout, void* sequence) {
  destroy_sequence(message_element(layout), sequence);
}

bool rosidl_typesupport_c__sequence_are_equal(const Layout* layout, const void* lhs, const void* rhs) {
  return are_equal_sequences(message_element(layout), lhs, rhs);
}

bool rosidl_typesupport_c__sequence_copy(const Layout* layout, const void* input, void* output) {
  return copy_sequence(message_element(layout), input, output);
}
