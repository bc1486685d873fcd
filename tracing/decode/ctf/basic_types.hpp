// SPDX-License-Identifier: Apache-2.0
// Makes the types of integers, real numbers and strings from the entries of their blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tracing/decode/ctf/field_class.hpp"
#include "tracing/decode/ctf/tsdl_cursor.hpp"

namespace tracing::ctf {

// An entry of a block: `name = value;` or `name := type;`.
struct TsdlEntry {
  std::string name;
  TsdlValue value;
  FieldClassPtr type;  // null: the entry has a value
  std::size_t line = 0;
};

// The functions throw UnsupportedTrace. `line` is for errors that belong to no entry; `native_is_big_endian` is the
// byte order of the trace.
std::uint64_t number_of(const TsdlEntry& entry);
std::uint32_t checked_alignment(std::uint64_t alignment, std::size_t line);
bool is_big_endian(const std::string& order, bool native_is_big_endian, std::size_t line);

FieldClassPtr integer_type(const std::vector<TsdlEntry>& entries, bool native_is_big_endian, std::size_t line);
FieldClassPtr real_type(const std::vector<TsdlEntry>& entries, bool native_is_big_endian, std::size_t line);
FieldClassPtr string_type();

}  // namespace tracing::ctf
