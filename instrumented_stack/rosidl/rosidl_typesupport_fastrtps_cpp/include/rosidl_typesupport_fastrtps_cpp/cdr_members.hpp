// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "fastcdr_versions/cdr.hpp"
#include "rosidl_runtime_cpp/bounded_vector.hpp"
#include "rosidl_typesupport_fastrtps_cpp/cdr_codec.hpp"

// The bytes of message members, as rmw_fastrtps_cpp writes them: plain CDR, the version before XTypes.
//   primitives         aligned to their size
//   string             u32 length with the final NUL, characters, NUL
//   wstring            u32 length, a u32 per UTF-16 unit, no final NUL
//   array              its elements; an empty one adds no padding
//   sequence           u32 length, its elements
// Only the generated source files include this header.
namespace rosidl_typesupport_fastrtps_cpp {

template <typename T>
struct is_std_array : std::false_type {};
template <typename T, std::size_t N>
struct is_std_array<std::array<T, N>> : std::true_type {};

template <typename T>
struct is_sequence : std::false_type {};
template <typename T>
struct is_sequence<std::vector<T>> : std::true_type {};
template <typename T, std::size_t N>
struct is_sequence<rosidl_runtime_cpp::BoundedVector<T, N>> : std::true_type {};

// A bool is not copied as part of a block, because reading must check that it is 0 or 1, and because std::vector<bool>
// stores bits.
template <typename T>
inline constexpr bool is_block_of_primitives = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

inline std::size_t aligned(std::size_t position, std::size_t alignment) {
  return (position + alignment - 1) & ~(alignment - 1);
}

template <typename T>
void cdr_write(eprosima::fastcdr::Cdr& cdr, const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    cdr.serialize(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    // Fast CDR's function for strings is not used, because it stops at an embedded NUL.
    cdr.serialize(static_cast<uint32_t>(value.size() + 1));
    fastcdr_versions::write_array(cdr, value.c_str(), value.size() + 1);
  } else if constexpr (std::is_same_v<T, std::u16string>) {
    cdr.serialize(static_cast<uint32_t>(value.size()));
    for (const char16_t unit : value) {
      cdr.serialize(static_cast<uint32_t>(unit));
    }
  } else if constexpr (is_std_array<T>::value || is_sequence<T>::value) {
    using Element = typename T::value_type;
    if constexpr (is_sequence<T>::value) {
      cdr.serialize(static_cast<uint32_t>(value.size()));
    }
    if constexpr (is_block_of_primitives<Element>) {
      if (!value.empty()) {
        fastcdr_versions::write_array(cdr, value.data(), value.size());
      }
    } else {
      for (std::size_t i = 0; i < value.size(); ++i) {
        cdr_write<Element>(cdr, value[i]);
      }
    }
  } else {
    CdrCodec<T>::write(cdr, value);
  }
}

// Reads a length and checks it against the remaining bytes, before memory is allocated for it. So the memory of a
// message is at most a small multiple of its bytes, whatever the bytes are.
inline std::size_t read_length(eprosima::fastcdr::Cdr& cdr, std::size_t least_element_size) {
  uint32_t length = 0;
  cdr.deserialize(length);
  if (!fastcdr_versions::has_left(cdr, length * least_element_size)) {
    throw std::length_error("a length in the message goes beyond the message");
  }
  return length;
}

template <typename T>
constexpr std::size_t least_size() {
  if constexpr (std::is_arithmetic_v<T>) {
    return sizeof(T);
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::u16string>) {
    return sizeof(uint32_t);
  } else if constexpr (is_std_array<T>::value) {
    return std::tuple_size_v<T> * least_size<typename T::value_type>();
  } else if constexpr (is_sequence<T>::value) {
    return sizeof(uint32_t);
  } else {
    return CdrCodec<T>::least_size;
  }
}

template <typename T>
void cdr_read(eprosima::fastcdr::Cdr& cdr, T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    cdr.deserialize(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    const std::size_t length = read_length(cdr, 1);
    value.resize(length);
    if (length != 0) {
      fastcdr_versions::read_array(cdr, value.data(), length);
      // Some writers do not count the final NUL.
      if (value.back() == '\0') {
        value.pop_back();
      }
    }
  } else if constexpr (std::is_same_v<T, std::u16string>) {
    value.resize(read_length(cdr, sizeof(uint32_t)));
    for (char16_t& unit : value) {
      uint32_t character = 0;
      cdr.deserialize(character);
      unit = static_cast<char16_t>(character);
    }
  } else if constexpr (is_std_array<T>::value || is_sequence<T>::value) {
    using Element = typename T::value_type;
    if constexpr (is_sequence<T>::value) {
      value.resize(read_length(cdr, least_size<Element>()));
    }
    if constexpr (is_block_of_primitives<Element>) {
      if (!value.empty()) {
        fastcdr_versions::read_array(cdr, value.data(), value.size());
      }
    } else if constexpr (std::is_same_v<Element, bool>) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        bool element = false;
        cdr.deserialize(element);
        value[i] = element;
      }
    } else {
      for (Element& element : value) {
        cdr_read(cdr, element);
      }
    }
  } else {
    CdrCodec<T>::read(cdr, value);
  }
}

// The position after `value` if it is written at `position`.
template <typename T>
std::size_t cdr_end_after(const T& value, std::size_t position) {
  if constexpr (std::is_arithmetic_v<T>) {
    return aligned(position, sizeof(T)) + sizeof(T);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return aligned(position, 4) + 4 + value.size() + 1;
  } else if constexpr (std::is_same_v<T, std::u16string>) {
    return aligned(position, 4) + 4 + 4 * value.size();
  } else if constexpr (is_std_array<T>::value || is_sequence<T>::value) {
    using Element = typename T::value_type;
    if constexpr (is_sequence<T>::value) {
      position = aligned(position, 4) + 4;
    }
    if constexpr (std::is_arithmetic_v<Element>) {
      return value.empty() ? position : aligned(position, sizeof(Element)) + value.size() * sizeof(Element);
    } else {
      for (const Element& element : value) {
        position = cdr_end_after(element, position);
      }
      return position;
    }
  } else {
    return CdrCodec<T>::end_after(value, position);
  }
}

inline void MaxSize::add_primitives(std::size_t size, std::size_t count) {
  if (count != 0) {
    end = aligned(end, size) + count * size;
  }
}

template <typename T>
void MaxSize::add(std::size_t string_bound) {
  if constexpr (std::is_arithmetic_v<T>) {
    add_primitives(sizeof(T), 1);
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::u16string>) {
    constexpr bool wide = std::is_same_v<T, std::u16string>;
    plain = false;
    bounded = bounded && string_bound != kUnbounded;
    const std::size_t length = string_bound == kUnbounded ? 0 : string_bound;
    add_primitives(4, 1);
    end += wide ? 4 * length : length + 1;
  } else if constexpr (is_std_array<T>::value || is_sequence<T>::value) {
    using Element = typename T::value_type;
    std::size_t count = 0;
    if constexpr (is_std_array<T>::value) {
      count = std::tuple_size_v<T>;
    } else {
      plain = false;
      add_primitives(4, 1);
      if constexpr (std::is_same_v<T, std::vector<Element>>) {
        bounded = false;
      } else {
        count = T::max_size();
      }
    }
    if constexpr (std::is_arithmetic_v<Element>) {
      add_primitives(sizeof(Element), count);
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        add<Element>(string_bound);
      }
    }
  } else {
    CdrCodec<T>::add_to(*this);
  }
}

}  // namespace rosidl_typesupport_fastrtps_cpp
