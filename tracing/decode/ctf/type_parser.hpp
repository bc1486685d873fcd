// SPDX-License-Identifier: Apache-2.0
// Reads the types of metadata by recursive descent, as far as tracers use them, and the blocks in which types stand.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tracing/decode/ctf/basic_types.hpp"
#include "tracing/decode/ctf/field_class.hpp"
#include "tracing/decode/ctf/tsdl_cursor.hpp"

namespace tracing::ctf {

// Moves the cursor, and throws UnsupportedTrace for text that it does not know.
class TypeParser {
 public:
  // `is_big_endian` is the byte order of the trace.
  TypeParser(TsdlCursor& cursor, bool is_big_endian) : cursor_(cursor), is_big_endian_(is_big_endian), scopes_(1) {}

  // `WORD { ENTRY … }`. The names of types that the block declares are known in the block alone.
  std::vector<TsdlEntry> parse_block();
  // `typealias TYPE := NAME …;`
  void parse_type_alias();
  // A type. When several words name the type, the last word may be the name of the field that follows.
  FieldClassPtr parse_type();

 private:
  // Counts the types and blocks around the cursor.
  class Level;
  // The types by name, visible in the block that declares them and in the blocks inside it.
  using Scope = std::map<std::string, FieldClassPtr>;  // "uint32_t", "struct packet_context"

  FieldClassPtr parse_named_type();
  FieldClassPtr parse_string();
  FieldClassPtr parse_structure();
  FieldClassPtr parse_variant();
  FieldClassPtr parse_enumeration();
  std::vector<EnumerationRange> parse_ranges();
  std::vector<FieldMember> parse_members();
  FieldMember parse_declarator(FieldClassPtr type);

  FieldClassPtr known_type(const std::string& name) const;  // null: unknown
  FieldClassPtr named(const std::string& name) const;
  FieldClassPtr declare(const std::string& name, FieldClass type);
  FieldClassPtr checked(FieldClass type) const;

  TsdlCursor& cursor_;
  const bool is_big_endian_;
  std::vector<Scope> scopes_;
  std::uint32_t level_ = 0;
};

}  // namespace tracing::ctf
