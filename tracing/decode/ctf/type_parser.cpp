// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/type_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tracing::ctf {

class TypeParser::Level {
 public:
  explicit Level(TypeParser& parser) : level_(parser.level_) {
    if (level_ == kMostLevels) {
      parser.cursor_.fail(fmt::format("more than {} types inside one another", kMostLevels));
    }
    ++level_;
  }
  ~Level() { --level_; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  std::uint32_t& level_;
};

std::vector<TsdlEntry> TypeParser::parse_block() {
  const Level level(*this);
  cursor_.take();
  cursor_.expect("{");
  scopes_.emplace_back();
  std::vector<TsdlEntry> entries;
  while (!cursor_.take_if("}")) {
    if (cursor_.peek().kind == Token::Kind::kEnd) {
      cursor_.fail("a block has no end");
    }
    if (cursor_.take_if(";")) {
      continue;
    }
    if (cursor_.peek().is("typealias")) {
      parse_type_alias();
      continue;
    }
    TsdlEntry entry;
    entry.line = cursor_.line();
    entry.name = cursor_.take_path();
    if (cursor_.take_if(":=")) {
      entry.type = parse_type();
    } else {
      cursor_.expect("=");
      entry.value = cursor_.take_value();
    }
    cursor_.expect(";");
    entries.push_back(std::move(entry));
  }
  scopes_.pop_back();
  cursor_.take_if(";");
  return entries;
}

void TypeParser::parse_type_alias() {
  cursor_.take();
  FieldClassPtr type = parse_type();
  cursor_.expect(":=");
  std::string name;
  while (cursor_.at_name()) {
    name += (name.empty() ? "" : " ") + cursor_.take().text;
  }
  cursor_.expect(";");
  scopes_.back()[name] = std::move(type);
}

FieldClassPtr TypeParser::parse_type() {
  const Level level(*this);
  const Token& word = cursor_.peek();
  if (word.is("integer")) {
    const std::vector<TsdlEntry> entries = parse_block();
    return integer_type(entries, is_big_endian_, cursor_.line());
  }
  if (word.is("floating_point")) {
    const std::vector<TsdlEntry> entries = parse_block();
    return real_type(entries, is_big_endian_, cursor_.line());
  }
  if (word.is("string")) {
    return parse_string();
  }
  if (word.is("struct")) {
    return parse_structure();
  }
  if (word.is("variant")) {
    return parse_variant();
  }
  if (word.is("enum")) {
    return parse_enumeration();
  }
  return parse_named_type();
}

FieldClassPtr TypeParser::parse_named_type() {
  std::string name;
  while (cursor_.at_name()) {
    const std::string longer = name + (name.empty() ? "" : " ") + cursor_.peek().text;
    // `unsigned long x;`: all names but the last, unless all of them are the type.
    if (!name.empty() && known_type(name) && !known_type(longer)) {
      break;
    }
    name = longer;
    cursor_.take();
  }
  return named(name);
}

// `string`, `string {…}`
FieldClassPtr TypeParser::parse_string() {
  if (cursor_.peek(1).is("{")) {
    parse_block();
  } else {
    cursor_.take();
  }
  return string_type();
}

// `struct NAME`, `struct NAME {…} align(N)`, `struct {…}`
FieldClassPtr TypeParser::parse_structure() {
  cursor_.take();
  const std::string name = cursor_.at_name() ? "struct " + cursor_.take().text : "";
  if (!cursor_.peek().is("{")) {
    return named(name);
  }
  FieldClass structure;
  structure.kind = FieldKind::kStructure;
  structure.members = parse_members();
  if (cursor_.take_if("align")) {
    cursor_.expect("(");
    const std::size_t line = cursor_.line();
    structure.alignment = checked_alignment(static_cast<std::uint64_t>(cursor_.take_number()), line);
    cursor_.expect(")");
  }
  for (const FieldMember& member : structure.members) {
    structure.alignment = std::max(structure.alignment, member.type->alignment);
  }
  return declare(name, std::move(structure));
}

// `variant NAME <path>`, `variant <path> {…}`, `variant NAME {…}`
FieldClassPtr TypeParser::parse_variant() {
  cursor_.take();
  const std::string name = cursor_.at_name() ? "variant " + cursor_.take().text : "";
  std::string path;
  if (cursor_.take_if("<")) {
    path = cursor_.take_field_path();
    cursor_.expect(">");
  }
  FieldClass variant;
  if (cursor_.peek().is("{")) {
    variant.kind = FieldKind::kVariant;
    variant.members = parse_members();
  } else {
    variant = *named(name);
  }
  if (!path.empty()) {
    variant.path = path;
  }
  return declare(name, std::move(variant));
}

// `enum NAME`, `enum [NAME] [: type] {…}`
FieldClassPtr TypeParser::parse_enumeration() {
  cursor_.take();
  const std::string name = cursor_.at_name() ? "enum " + cursor_.take().text : "";
  FieldClassPtr container;
  if (cursor_.take_if(":")) {
    container = parse_type();
  }
  if (!cursor_.peek().is("{")) {
    return named(name);
  }
  if (!container) {
    container = known_type("int");
  }
  if (!container || container->kind != FieldKind::kInteger) {
    cursor_.fail("an enumeration of an unknown integer");
  }
  FieldClass enumeration = *container;
  enumeration.kind = FieldKind::kEnumeration;
  enumeration.ranges = parse_ranges();
  return declare(name, std::move(enumeration));
}

// `{LABEL, LABEL = 2, LABEL = 3 ... 5}`
std::vector<EnumerationRange> TypeParser::parse_ranges() {
  cursor_.expect("{");
  std::vector<EnumerationRange> ranges;
  std::int64_t next = 0;
  while (!cursor_.take_if("}")) {
    if (!cursor_.at_name() && cursor_.peek().kind != Token::Kind::kString) {
      cursor_.fail("expected a label");
    }
    EnumerationRange range{cursor_.take().text, next, next};
    if (cursor_.take_if("=")) {
      range.first = range.last = cursor_.take_number();
      if (cursor_.take_if("...")) {
        range.last = cursor_.take_number();
      }
    }
    next = static_cast<std::int64_t>(static_cast<std::uint64_t>(range.last) + 1);
    ranges.push_back(std::move(range));
    if (!cursor_.peek().is("}")) {
      cursor_.expect(",");
    }
  }
  return ranges;
}

std::vector<FieldMember> TypeParser::parse_members() {
  cursor_.expect("{");
  scopes_.emplace_back();
  std::vector<FieldMember> members;
  while (!cursor_.take_if("}")) {
    if (cursor_.peek().kind == Token::Kind::kEnd) {
      cursor_.fail("a structure has no end");
    }
    if (cursor_.peek().is("typealias")) {
      parse_type_alias();
      continue;
    }
    const FieldClassPtr type = parse_type();
    do {
      members.push_back(parse_declarator(type));
    } while (cursor_.take_if(","));
    cursor_.expect(";");
  }
  scopes_.pop_back();
  return members;
}

// NAME, NAME[8], NAME[length], NAME[2][3]
FieldMember TypeParser::parse_declarator(FieldClassPtr type) {
  if (!cursor_.at_name()) {
    cursor_.fail(fmt::format("expected the name of a field, found '{}'", cursor_.peek().text));
  }
  FieldMember member{without_underscore(cursor_.take().text), std::move(type)};
  std::vector<FieldClass> dimensions;
  while (cursor_.take_if("[")) {
    FieldClass array;
    if (cursor_.peek().kind == Token::Kind::kNumber) {
      array.kind = FieldKind::kArray;
      array.length = cursor_.take().number;
    } else {
      array.kind = FieldKind::kSequence;
      array.path = cursor_.take_field_path();
    }
    cursor_.expect("]");
    dimensions.push_back(std::move(array));
  }
  for (auto array = dimensions.rbegin(); array != dimensions.rend(); ++array) {
    array->alignment = member.type->alignment;
    array->element = std::move(member.type);
    member.type = checked(std::move(*array));
  }
  return member;
}

FieldClassPtr TypeParser::known_type(const std::string& name) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    if (const auto found = scope->find(name); found != scope->end()) {
      return found->second;
    }
  }
  return nullptr;
}

FieldClassPtr TypeParser::named(const std::string& name) const {
  if (FieldClassPtr type = known_type(name)) {
    return type;
  }
  cursor_.fail(fmt::format("unknown type '{}'", name));
}

FieldClassPtr TypeParser::declare(const std::string& name, FieldClass type) {
  FieldClassPtr declared = checked(std::move(type));
  if (!name.empty()) {
    scopes_.back()[name] = declared;
  }
  return declared;
}

FieldClassPtr TypeParser::checked(FieldClass type) const {
  FieldClassPtr complete_type = complete(std::move(type));
  if (complete_type->depth > kMostLevels) {
    cursor_.fail(fmt::format("more than {} types inside one another", kMostLevels));
  }
  if (complete_type->fields > kMostFields) {
    cursor_.fail(fmt::format("a type with more than {} fields", kMostFields));
  }
  return complete_type;
}

}  // namespace tracing::ctf
