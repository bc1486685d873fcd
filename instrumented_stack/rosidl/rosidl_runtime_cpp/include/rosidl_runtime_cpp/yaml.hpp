// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>

#include "rosidl_runtime_cpp/traits.hpp"

// Prints the members of messages as YAML. Reading it back gives the same values. Only the generated source files
// include this header.
namespace rosidl_runtime_cpp::yaml {

// The shortest digits that read back as the same number. They can always be recognised as floating point.
template <typename Float>
void write_floating(std::ostream& out, Float value) {
  if (std::isnan(value)) {
    out << ".nan";
  } else if (std::isinf(value)) {
    out << (value < 0 ? "-.inf" : ".inf");
  } else {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    const std::string text(digits, end);
    out << text << (text.find_first_of(".e") == std::string::npos ? ".0" : "");
  }
}

// A double-quoted YAML scalar. Bytes above 127 are treated as UTF-8 and do not change.
inline void write_quoted(std::ostream& out, const std::string& text) {
  constexpr char hex[] = "0123456789abcdef";
  out << '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out << '\\' << c;
    } else if (c == '\n') {
      out << "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out << "\\x" << hex[byte >> 4] << hex[byte & 15];
    } else {
      out << c;
    }
  }
  out << '"';
}

inline void write_quoted(std::ostream& out, const std::u16string& text) {
  constexpr char hex[] = "0123456789abcdef";
  out << '"';
  for (const char16_t unit : text) {
    if (unit >= 0x20 && unit < 0x7f && unit != '"' && unit != '\\') {
      out << static_cast<char>(unit);
    } else {
      out << "\\u" << hex[unit >> 12] << hex[(unit >> 8) & 15] << hex[(unit >> 4) & 15] << hex[unit & 15];
    }
  }
  out << '"';
}

template <typename T>
inline constexpr bool is_text = std::is_same_v<T, std::string> || std::is_same_v<T, std::u16string>;

template <typename T>
inline constexpr bool is_scalar = std::is_arithmetic_v<T> || is_text<T>;

template <typename T>
void write_flow(std::ostream& out, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    out << (value ? "true" : "false");
  } else if constexpr (std::is_floating_point_v<T>) {
    write_floating(out, value);
  } else if constexpr (std::is_integral_v<T>) {
    out << +value;
  } else if constexpr (is_text<T>) {
    write_quoted(out, value);
  } else if constexpr (rosidl_generator_traits::is_message<T>::value) {
    to_flow_style_yaml(value, out);
  } else {
    out << '[';
    for (std::size_t i = 0; i < value.size(); ++i) {
      out << (i == 0 ? "" : ", ");
      write_flow<typename T::value_type>(out, value[i]);
    }
    out << ']';
  }
}

template <typename T>
void write_flow_member(std::ostream& out, bool first, const char* name, const T& value) {
  out << (first ? "" : ", ") << name << ": ";
  write_flow(out, value);
}

// Prints a member with its name, on separate lines.
template <typename T>
void write_member(std::ostream& out, const char* name, const T& value, std::size_t indentation) {
  const std::string spaces(indentation, ' ');
  out << spaces << name << ':';
  if constexpr (is_scalar<T>) {
    out << ' ';
    write_flow(out, value);
    out << '\n';
  } else if constexpr (rosidl_generator_traits::is_message<T>::value) {
    out << '\n';
    to_block_style_yaml(value, out, indentation + 2);
  } else if (value.empty()) {
    out << " []\n";
  } else {
    using Element = typename T::value_type;
    out << '\n';
    for (std::size_t i = 0; i < value.size(); ++i) {
      out << spaces << "- ";
      if constexpr (is_scalar<Element>) {
        write_flow<Element>(out, value[i]);
        out << '\n';
      } else {
        // Printed in one line, because a message in a list has no name to print on a separate line.
        to_flow_style_yaml(value[i], out);
        out << '\n';
      }
    }
  }
}

template <typename Message>
std::string to_string(const Message& message, bool use_flow_style) {
  std::ostringstream out;
  if (use_flow_style) {
    to_flow_style_yaml(message, out);
  } else {
    to_block_style_yaml(message, out, 0);
  }
  return out.str();
}

}  // namespace rosidl_runtime_cpp::yaml
