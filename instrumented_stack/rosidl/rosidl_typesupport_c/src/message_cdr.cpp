// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "fastcdr_versions/cdr.hpp"
#include "rosidl_runtime_c/string_functions.h"
#include "rosidl_runtime_c/u16string_functions.h"
#include "rosidl_typesupport_c/element.hpp"
#include "rosidl_typesupport_c/type_support.hpp"
#include "rosidl_typesupport_fastrtps_cpp/cdr_members.hpp"

namespace rosidl_typesupport_c {
namespace {

using eprosima::fastcdr::Cdr;
using rosidl_typesupport_fastrtps_cpp::aligned;
using rosidl_typesupport_fastrtps_cpp::MaxSize;
using rosidl_typesupport_fastrtps_cpp::read_length;

constexpr std::size_t kLengthSize = sizeof(std::uint32_t);

void write_message(const Layout& layout, const void* message, Cdr& cdr);
void read_message(const Layout& layout, Cdr& cdr, void* message);
std::size_t end_after_message(const Layout& layout, const void* message, std::size_t position);
void add_message(const Layout& layout, MaxSize& size);

// Primitives are read and written in blocks of unsigned numbers of their size.
template <typename Function>
void with_number_type(std::size_t size, Function function) {
  switch (size) {
    case 1:
      return function(std::uint8_t{});
    case 2:
      return function(std::uint16_t{});
    case 4:
      return function(std::uint32_t{});
    default:
      return function(std::uint64_t{});
  }
}

void write_elements(const Element& element, const void* elements, std::size_t count, Cdr& cdr) {
  if (count == 0) {
    return;
  }
  if (element.is_primitive()) {
    with_number_type(element.size, [&](auto number) {
      fastcdr_versions::write_array(cdr, static_cast<const decltype(number)*>(elements), count);
    });
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const void* one = at(element, elements, i);
    if (element.kind == Element::kString) {
      const auto& text = *static_cast<const rosidl_runtime_c__String*>(one);
      if (text.data == nullptr || text.data[text.size] != '\0') {
        throw std::invalid_argument("a string does not end with a NUL");
      }
      cdr.serialize(static_cast<std::uint32_t>(text.size + 1));
      fastcdr_versions::write_array(cdr, text.data, text.size + 1);
    } else if (element.kind == Element::kWideString) {
      const auto& text = *static_cast<const rosidl_runtime_c__U16String*>(one);
      cdr.serialize(static_cast<std::uint32_t>(text.size));
      for (std::size_t unit = 0; unit < text.size; ++unit) {
        cdr.serialize(static_cast<std::uint32_t>(text.data[unit]));
      }
    } else {
      write_message(*element.message, one, cdr);
    }
  }
}

void write_message(const Layout& layout, const void* message, Cdr& cdr) {
  for (std::size_t i = 0; i < layout.description->field_count; ++i) {
    const Field field = field_of(layout, i);
    const void* value = member(message, field.offset);
    if (!field.is_sequence()) {
      write_elements(field.element, value, field.count, cdr);
      continue;
    }
    const Sequence sequence = load(value);
    if (field.shape == Field::kBoundedSequence && sequence.size > field.count) {
      throw std::length_error("a sequence is longer than its bound");
    }
    cdr.serialize(static_cast<std::uint32_t>(sequence.size));
    write_elements(field.element, sequence.data, sequence.size, cdr);
  }
}

std::size_t least_cdr_size(const Element& element) {
  if (element.is_primitive()) {
    return element.size;
  }
  return element.kind == Element::kMessage ? element.message->least_cdr_size : kLengthSize;
}

void check_memory(bool enough) {
  if (!enough) {
    throw std::bad_alloc();
  }
}

void read_elements(const Element& element, Cdr& cdr, void* elements, std::size_t count) {
  if (count == 0) {
    return;
  }
  if (element.kind == Element::kBool) {
    // Reading each checks that it is 0 or 1.
    for (std::size_t i = 0; i < count; ++i) {
      cdr.deserialize(static_cast<bool*>(elements)[i]);
    }
    return;
  }
  if (element.is_primitive()) {
    with_number_type(element.size, [&](auto number) {
      fastcdr_versions::read_array(cdr, static_cast<decltype(number)*>(elements), count);
    });
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    void* one = at(element, elements, i);
    if (element.kind == Element::kString) {
      auto& text = *static_cast<rosidl_runtime_c__String*>(one);
      const std::size_t length = read_length(cdr, 1);
      check_memory(rosidl_runtime_c__String__resize(&text, length));
      if (length != 0) {
        fastcdr_versions::read_array(cdr, text.data, length);
        // Some writers do not count the final NUL.
        text.size -= text.data[length - 1] == '\0' ? 1 : 0;
      }
    } else if (element.kind == Element::kWideString) {
      auto& text = *static_cast<rosidl_runtime_c__U16String*>(one);
      check_memory(rosidl_runtime_c__U16String__resize(&text, read_length(cdr, sizeof(std::uint32_t))));
      for (std::size_t unit = 0; unit < text.size; ++unit) {
        std::uint32_t character = 0;
        cdr.deserialize(character);
        text.data[unit] = static_cast<std::uint16_t>(character);
      }
    } else {
      read_message(*element.message, cdr, one);
    }
  }
}

void read_message(const Layout& layout, Cdr& cdr, void* message) {
  for (std::size_t i = 0; i < layout.description->field_count; ++i) {
    const Field field = field_of(layout, i);
    void* value = member(message, field.offset);
    if (!field.is_sequence()) {
      read_elements(field.element, cdr, value, field.count);
      continue;
    }
    const std::size_t length = read_length(cdr, least_cdr_size(field.element));
    if (field.shape == Field::kBoundedSequence && length > field.count) {
      throw std::length_error("a sequence is longer than its bound");
    }
    check_memory(resize(field.element, value, length));
    read_elements(field.element, cdr, load(value).data, length);
  }
}

std::size_t end_after_elements(const Element& element, const void* elements, std::size_t count, std::size_t position) {
  if (count == 0) {
    return position;
  }
  if (element.is_primitive()) {
    return aligned(position, element.size) + count * element.size;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const void* one = at(element, elements, i);
    if (element.kind == Element::kString) {
      position =
          aligned(position, kLengthSize) + kLengthSize + static_cast<const rosidl_runtime_c__String*>(one)->size + 1;
    } else if (element.kind == Element::kWideString) {
      position = aligned(position, kLengthSize) + kLengthSize +
                 sizeof(std::uint32_t) * static_cast<const rosidl_runtime_c__U16String*>(one)->size;
    } else {
      position = end_after_message(*element.message, one, position);
    }
  }
  return position;
}

std::size_t end_after_message(const Layout& layout, const void* message, std::size_t position) {
  for (std::size_t i = 0; i < layout.description->field_count; ++i) {
    const Field field = field_of(layout, i);
    const void* value = member(message, field.offset);
    if (field.is_sequence()) {
      const Sequence sequence = load(value);
      position =
          end_after_elements(field.element, sequence.data, sequence.size, aligned(position, kLengthSize) + kLengthSize);
    } else {
      position = end_after_elements(field.element, value, field.count, position);
    }
  }
  return position;
}

void add_field(const Field& field, MaxSize& size) {
  if (field.is_sequence()) {
    size.plain = false;
    size.bounded = size.bounded && field.shape == Field::kBoundedSequence;
    size.add_primitives(kLengthSize, 1);
  }
  if (field.element.is_primitive()) {
    size.add_primitives(field.element.size, field.count);
    return;
  }
  for (std::size_t i = 0; i < field.count; ++i) {
    if (field.element.kind == Element::kMessage) {
      add_message(*field.element.message, size);
    } else {
      const std::size_t bound = field.string_bound == 0 ? MaxSize::kUnbounded : field.string_bound;
      field.element.kind == Element::kString ? size.add<std::string>(bound) : size.add<std::u16string>(bound);
    }
  }
}

void add_message(const Layout& layout, MaxSize& size) {
  const std::size_t begin = size.end;
  for (std::size_t i = 0; i < layout.description->field_count; ++i) {
    add_field(field_of(layout, i), size);
  }
  const Field last = field_of(layout, layout.description->field_count - 1);
  size.plain = size.plain && size.end - begin == last.offset + last.count * last.element.size;
}

}  // namespace

bool write(const Layout& layout, const void* message, Cdr& cdr) {
  return fastcdr_versions::succeeds([&] { write_message(layout, message, cdr); });
}

bool read(const Layout& layout, Cdr& cdr, void* message) {
  return fastcdr_versions::succeeds([&] { read_message(layout, cdr, message); });
}

std::uint32_t serialized_size(const Layout& layout, const void* message) {
  return static_cast<std::uint32_t>(end_after_message(layout, message, 0));
}

std::size_t max_serialized_size(const Layout& layout, char& bounds_info) {
  MaxSize size;
  add_message(layout, size);
  bounds_info = ROSIDL_TYPESUPPORT_FASTRTPS_UNBOUNDED_TYPE;
  if (size.bounded) {
    bounds_info = size.plain ? ROSIDL_TYPESUPPORT_FASTRTPS_PLAIN_TYPE : ROSIDL_TYPESUPPORT_FASTRTPS_BOUNDED_TYPE;
  }
  return size.end;
}

}  // namespace rosidl_typesupport_c
