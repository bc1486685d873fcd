// SPDX-License-Identifier: Apache-2.0
#include "rosidl_typesupport_c/element.hpp"

#include <cstdlib>
#include <cstring>

#include "rosidl_runtime_c/string_functions.h"
#include "rosidl_runtime_c/u16string_functions.h"

namespace rosidl_typesupport_c {
namespace {

// The constants of type_description_interfaces/msg/FieldType. The type of an array or a sequence is that of its
// elements and one of the offsets.
constexpr std::uint8_t kMessageType = 1;
constexpr std::uint8_t kArrayOffset = 48;
constexpr std::uint8_t kBoundedSequenceOffset = 96;
constexpr std::uint8_t kSequenceOffset = 144;

Element element_of(std::uint8_t type, const Layout* nested) {
  switch (type) {
    case kMessageType:
      return {Element::kMessage, nested->size, nested};
    case 4:
    case 5:
      return {Element::kInteger, 2, nullptr};
    case 6:
    case 7:
      return {Element::kInteger, 4, nullptr};
    case 8:
    case 9:
      return {Element::kInteger, 8, nullptr};
    case 10:
      return {Element::kFloat, sizeof(float), nullptr};
    case 11:
      return {Element::kDouble, sizeof(double), nullptr};
    case 15:
      return {Element::kBool, sizeof(bool), nullptr};
    case 17:
    case 21:
      return {Element::kString, sizeof(rosidl_runtime_c__String), nullptr};
    case 18:
    case 22:
      return {Element::kWideString, sizeof(rosidl_runtime_c__U16String), nullptr};
    default:  // 2, 3, 13, 16
      return {Element::kInteger, 1, nullptr};
  }
}

template <typename Number>
bool equal_numbers(const void* lhs, const void* rhs, std::size_t count) {
  const auto* one = static_cast<const Number*>(lhs);
  const auto* other = static_cast<const Number*>(rhs);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(one[i] == other[i])) {
      return false;
    }
  }
  return true;
}

bool init_one(const Element& element, void* target) {
  switch (element.kind) {
    case Element::kString:
      return rosidl_runtime_c__String__init(static_cast<rosidl_runtime_c__String*>(target));
    case Element::kWideString:
      return rosidl_runtime_c__U16String__init(static_cast<rosidl_runtime_c__U16String*>(target));
    default:
      return rosidl_typesupport_c__message_init(element.message, target);
  }
}

bool equal_one(const Element& element, const void* lhs, const void* rhs) {
  switch (element.kind) {
    case Element::kString:
      return rosidl_runtime_c__String__are_equal(static_cast<const rosidl_runtime_c__String*>(lhs),
                                                 static_cast<const rosidl_runtime_c__String*>(rhs));
    case Element::kWideString:
      return rosidl_runtime_c__U16String__are_equal(static_cast<const rosidl_runtime_c__U16String*>(lhs),
                                                    static_cast<const rosidl_runtime_c__U16String*>(rhs));
    default:
      return rosidl_typesupport_c__message_are_equal(element.message, lhs, rhs);
  }
}

bool copy_one(const Element& element, const void* input, void* output) {
  switch (element.kind) {
    case Element::kString:
      return rosidl_runtime_c__String__copy(static_cast<const rosidl_runtime_c__String*>(input),
                                            static_cast<rosidl_runtime_c__String*>(output));
    case Element::kWideString:
      return rosidl_runtime_c__U16String__copy(static_cast<const rosidl_runtime_c__U16String*>(input),
                                               static_cast<rosidl_runtime_c__U16String*>(output));
    default:
      return rosidl_typesupport_c__message_copy(element.message, input, output);
  }
}

}  // namespace

Field field_of(const Layout& layout, std::size_t index) {
  const rosidl_field_description_t& description = layout.description->fields[index];
  std::uint8_t type = description.type_id;
  Field::Shape shape = Field::kOne;
  if (type > kSequenceOffset) {
    shape = Field::kSequence;
    type -= kSequenceOffset;
  } else if (type > kBoundedSequenceOffset) {
    shape = Field::kBoundedSequence;
    type -= kBoundedSequenceOffset;
  } else if (type > kArrayOffset) {
    shape = Field::kArray;
    type -= kArrayOffset;
  }
  return {element_of(type, layout.nested[index]), shape, layout.offsets[index],
          shape == Field::kOne ? 1 : static_cast<std::size_t>(description.capacity),
          static_cast<std::size_t>(description.string_capacity)};
}

Sequence load(const void* sequence) {
  Sequence value;
  std::memcpy(&value, sequence, sizeof value);
  return value;
}

void store(void* sequence, const Sequence& value) {
  std::memcpy(sequence, &value, sizeof value);
}

bool init(const Element& element, void* elements, std::size_t count) {
  if (element.is_primitive()) {
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!init_one(element, at(element, elements, i))) {
      fini(element, elements, i);
      return false;
    }
  }
  return true;
}

void fini(const Element& element, void* elements, std::size_t count) {
  if (element.is_primitive()) {
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    void* target = at(element, elements, i);
    if (element.kind == Element::kString) {
      rosidl_runtime_c__String__fini(static_cast<rosidl_runtime_c__String*>(target));
    } else if (element.kind == Element::kWideString) {
      rosidl_runtime_c__U16String__fini(static_cast<rosidl_runtime_c__U16String*>(target));
    } else {
      rosidl_typesupport_c__message_fini(element.message, target);
    }
  }
}

bool are_equal(const Element& element, const void* lhs, const void* rhs, std::size_t count) {
  if (count == 0) {
    return true;
  }
  if (element.kind == Element::kFloat) {
    return equal_numbers<float>(lhs, rhs, count);
  }
  if (element.kind == Element::kDouble) {
    return equal_numbers<double>(lhs, rhs, count);
  }
  if (element.is_primitive()) {
    return std::memcmp(lhs, rhs, count * element.size) == 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!equal_one(element, at(element, lhs, i), at(element, rhs, i))) {
      return false;
    }
  }
  return true;
}

bool copy(const Element& element, const void* input, void* output, std::size_t count) {
  if (element.is_primitive()) {
    if (count != 0) {
      std::memmove(output, input, count * element.size);
    }
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!copy_one(element, at(element, input, i), at(element, output, i))) {
      return false;
    }
  }
  return true;
}

bool resize(const Element& element, void* sequence, std::size_t size) {
  Sequence value = load(sequence);
  if (size > value.capacity) {
    if (size > SIZE_MAX / element.size) {
      return false;
    }
    void* data = std::realloc(value.data, size * element.size);
    if (data == nullptr) {
      return false;
    }
    value.data = data;
    void* added = at(element, data, value.capacity);
    std::memset(added, 0, (size - value.capacity) * element.size);
    if (!init(element, added, size - value.capacity)) {
      store(sequence, value);
      return false;
    }
    value.capacity = size;
  }
  value.size = size;
  store(sequence, value);
  return true;
}

bool init_sequence(const Element& element, void* sequence, std::size_t size) {
  if (sequence == nullptr) {
    return false;
  }
  store(sequence, {nullptr, 0, 0});
  if (!resize(element, sequence, size)) {
    fini_sequence(element, sequence);
    return false;
  }
  return true;
}

void fini_sequence(const Element& element, void* sequence) {
  if (sequence == nullptr) {
    return;
  }
  const Sequence value = load(sequence);
  if (value.data != nullptr) {
    fini(element, value.data, value.capacity);
    std::free(value.data);
  }
  store(sequence, {nullptr, 0, 0});
}

void* create_sequence(const Element& element, std::size_t size) {
  void* sequence = std::malloc(sizeof(Sequence));
  if (sequence != nullptr && !init_sequence(element, sequence, size)) {
    std::free(sequence);
    return nullptr;
  }
  return sequence;
}

void destroy_sequence(const Element& element, void* sequence) {
  fini_sequence(element, sequence);
  std::free(sequence);
}

bool are_equal_sequences(const Element& element, const void* lhs, const void* rhs) {
  if (lhs == nullptr || rhs == nullptr) {
    return false;
  }
  const Sequence one = load(lhs);
  const Sequence other = load(rhs);
  return one.size == other.size && are_equal(element, one.data, other.data, one.size);
}

bool copy_sequence(const Element& element, const void* input, void* output) {
  if (input == nullptr || output == nullptr) {
    return false;
  }
  const Sequence from = load(input);
  return resize(element, output, from.size) && copy(element, from.data, load(output).data, from.size);
}

}  // namespace rosidl_typesupport_c
