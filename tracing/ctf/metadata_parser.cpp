// SPDX-License-Identifier: Apache-2.0
// Reads TSDL by recursive descent, as far as tracers use it.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "tracing/ctf/trace_class.hpp"
#include "tracing/ctf/tsdl_tokens.hpp"

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kByte = 8;  // bits

// The right side of `name = value;`.
struct Value {
  enum class Kind { kNumber, kString, kPath } kind = Kind::kNumber;
  std::string text;         // of a string; the names of a path, joined by dots
  std::int64_t number = 0;  // of a number
};

// An entry of a block: `name = value;` or `name := type;`.
struct Entry {
  std::string name;
  Value value;
  FieldClassPtr type;  // null: the entry has a value
  std::size_t line = 0;
};

// Names of types, visible in the block that declares them and in the blocks inside it.
struct TypeScope {
  std::map<std::string, FieldClassPtr> types;  // "uint32_t", "struct packet_context"
};

std::string without_underscore(const std::string& name) {
  return name.size() > 1 && name[0] == '_' ? name.substr(1) : name;
}

NumberAccess access_of(const FieldClass& number) {
  const bool native = number.is_big_endian == (std::endian::native == std::endian::big) || number.size == kByte;
  if (number.kind == FieldKind::kReal || number.alignment % kByte != 0 || !native) return NumberAccess::kBits;
  switch (number.size) {
    case 8:
      return number.is_signed ? NumberAccess::kSigned8 : NumberAccess::kUnsigned8;
    case 16:
      return number.is_signed ? NumberAccess::kSigned16 : NumberAccess::kUnsigned16;
    case 32:
      return number.is_signed ? NumberAccess::kSigned32 : NumberAccess::kUnsigned32;
    case 64:
      return number.is_signed ? NumberAccess::kSigned64 : NumberAccess::kUnsigned64;
    default:
      return NumberAccess::kBits;
  }
}

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(tsdl_tokens(text)), scopes_(1) { find_byte_order(); }

  TraceClass parse() {
    while (peek().kind != Token::Kind::kEnd) parse_top_level();
    check_references();
    return std::move(trace_);
  }

 private:
  const Token& peek(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  const Token& take() {
    const Token& token = peek();
    if (at_ + 1 < tokens_.size()) ++at_;
    return token;
  }
  bool take_if(std::string_view text) {
    if (!peek().is(text)) return false;
    take();
    return true;
  }
  void expect(std::string_view text) {
    if (!take_if(text)) fail(fmt::format("expected '{}', found '{}'", text, peek().text));
  }
  [[noreturn]] void fail(const std::string& what) const { fail_at(peek().line, what); }
  [[noreturn]] static void fail_at(std::size_t line, const std::string& what) {
    throw UnsupportedTrace(fmt::format("metadata, line {}: {}", line, what));
  }

  // Finds the byte order first: types may be declared before the block `trace`, which gives the byte order.
  void find_byte_order() {
    for (std::size_t i = 0; i + 2 < tokens_.size(); ++i) {
      if (tokens_[i].is("byte_order") && tokens_[i + 1].is("=") && tokens_[i + 2].text != "native") {
        trace_.is_big_endian = is_big_endian(tokens_[i + 2].text, tokens_[i].line);
        return;
      }
    }
  }

  bool is_big_endian(const std::string& order, std::size_t line) const {
    if (order == "le") return false;
    if (order == "be" || order == "network") return true;
    if (order == "native") return trace_.is_big_endian;
    fail_at(line, fmt::format("unknown byte order '{}'", order));
  }

  void parse_top_level() {
    const std::string word = peek().kind == Token::Kind::kName ? peek().text : "";
    const bool is_block = peek(1).is("{");
    if (take_if(";")) return;
    if (word == "typealias") {
      parse_type_alias();
    } else if (word == "typedef") {
      fail("typedef is not known here");
    } else if (word == "trace" && is_block) {
      parse_trace();
    } else if (word == "env" && is_block) {
      parse_environment();
    } else if (word == "clock" && is_block) {
      parse_clock();
    } else if (word == "stream" && is_block) {
      parse_stream();
    } else if (word == "event" && is_block) {
      parse_event();
    } else if (word == "callsite" && is_block) {
      parse_block();
    } else {
      parse_type();  // a structure, a variant or an enumeration with a name
      expect(";");
    }
  }

  // ---- blocks

  std::vector<Entry> parse_block() {
    take();
    expect("{");
    scopes_.emplace_back();
    std::vector<Entry> entries;
    while (!take_if("}")) {
      if (peek().kind == Token::Kind::kEnd) fail("a block has no end");
      if (take_if(";")) continue;
      if (peek().is("typealias")) {
        parse_type_alias();
        continue;
      }
      Entry entry;
      entry.line = peek().line;
      entry.name = parse_path();
      if (take_if(":=")) {
        entry.type = parse_type();
      } else {
        expect("=");
        entry.value = parse_value();
      }
      expect(";");
      entries.push_back(std::move(entry));
    }
    scopes_.pop_back();
    take_if(";");
    return entries;
  }

  std::string parse_path() {
    if (peek().kind != Token::Kind::kName) fail(fmt::format("expected a name, found '{}'", peek().text));
    std::string path = take().text;
    while (take_if(".")) path += "." + take().text;
    return path;
  }

  // The path of a field, made of the names that FieldMember has.
  std::string parse_field_path() {
    if (peek().kind != Token::Kind::kName) fail(fmt::format("expected a field, found '{}'", peek().text));
    std::string path = without_underscore(take().text);
    while (take_if(".")) path += "." + without_underscore(take().text);
    return path;
  }

  Value parse_value() {
    Value value;
    if (peek().kind == Token::Kind::kString) {
      value.kind = Value::Kind::kString;
      while (peek().kind == Token::Kind::kString) value.text += take().text;
    } else if (peek().kind == Token::Kind::kName) {
      value.kind = Value::Kind::kPath;
      value.text = parse_path();
    } else {
      value.number = parse_number();
    }
    return value;
  }

  // Numbers beyond 63 bits keep their bits.
  std::int64_t parse_number() {
    const bool negative = take_if("-");
    if (!negative) take_if("+");
    if (peek().kind != Token::Kind::kNumber) fail(fmt::format("expected a number, found '{}'", peek().text));
    const auto number = static_cast<std::int64_t>(take().number);
    return negative ? -number : number;
  }

  static std::uint64_t number_of(const Entry& entry) {
    if (entry.value.kind != Value::Kind::kNumber) fail_at(entry.line, fmt::format("'{}' is no number", entry.name));
    return static_cast<std::uint64_t>(entry.value.number);
  }

  void parse_trace() {
    for (const Entry& entry : parse_block()) {
      if (entry.name == "uuid") trace_.uuid = entry.value.text;
      if (entry.name == "packet.header") trace_.packet_header = entry.type;
      if ((entry.name == "major" && entry.value.number != 1) || (entry.name == "minor" && entry.value.number != 8)) {
        fail_at(entry.line, "not CTF 1.8");
      }
    }
  }

  void parse_environment() {
    for (const Entry& entry : parse_block()) {
      trace_.environment[entry.name] = entry.value.kind == Value::Kind::kNumber ? EnvironmentValue(entry.value.number)
                                                                                : EnvironmentValue(entry.value.text);
    }
  }

  void parse_clock() {
    Clock clock;
    for (const Entry& entry : parse_block()) {
      if (entry.name == "name") clock.name = entry.value.text;
      if (entry.name == "uuid") clock.uuid = entry.value.text;
      if (entry.name == "freq") clock.frequency = number_of(entry);
      if (entry.name == "offset_s") clock.offset_s = entry.value.number;
      if (entry.name == "offset") clock.offset = entry.value.number;
    }
    if (clock.frequency == 0) fail("a clock has the frequency 0");
    trace_.clocks[clock.name] = clock;
  }

  void parse_stream() {
    StreamDeclaration stream;
    for (const Entry& entry : parse_block()) {
      if (entry.name == "id") stream.id = number_of(entry);
      if (entry.name == "packet.context") stream.packet_context = entry.type;
      if (entry.name == "event.header") stream.event_header = entry.type;
      if (entry.name == "event.context") stream.event_context = entry.type;
    }
    trace_.streams[stream.id] = stream;
  }

  void parse_event() {
    EventDeclaration event;
    for (const Entry& entry : parse_block()) {
      if (entry.name == "name") event.name = entry.value.text;
      if (entry.name == "id") event.id = number_of(entry);
      if (entry.name == "stream_id") event.stream_id = number_of(entry);
      if (entry.name == "context") event.context = entry.type;
      if (entry.name == "fields") event.payload = entry.type;
    }
    trace_.events.push_back(std::move(event));
  }

  void check_references() const {
    for (const EventDeclaration& event : trace_.events) {
      if (!trace_.streams.contains(event.stream_id)) {
        throw UnsupportedTrace(fmt::format("the event '{}' belongs to an unknown stream", event.name));
      }
    }
  }

  // ---- types

  // typealias TYPE := NAME ...;
  void parse_type_alias() {
    take();
    FieldClassPtr type = parse_type();
    expect(":=");
    std::string name;
    while (peek().kind == Token::Kind::kName) name += (name.empty() ? "" : " ") + take().text;
    expect(";");
    scopes_.back().types[name] = std::move(type);
  }

  FieldClassPtr known_type(const std::string& name) const {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
      if (const auto found = scope->types.find(name); found != scope->types.end()) return found->second;
    }
    return nullptr;
  }

  // A type. When several words name the type, the last word may be the name of the field that follows.
  FieldClassPtr parse_type() {
    if (peek().is("integer")) return parse_integer();
    if (peek().is("floating_point")) return parse_real();
    if (peek().is("string")) return parse_string();
    if (peek().is("struct")) return parse_structure();
    if (peek().is("variant")) return parse_variant();
    if (peek().is("enum")) return parse_enumeration();
    std::string name;
    while (peek().kind == Token::Kind::kName) {
      const std::string longer = name + (name.empty() ? "" : " ") + peek().text;
      // `unsigned long x;`: all names but the last, unless all of them are the type.
      if (!name.empty() && known_type(name) && !known_type(longer)) break;
      name = longer;
      take();
    }
    if (FieldClassPtr type = known_type(name)) return type;
    fail(fmt::format("unknown type '{}'", name));
  }

  std::uint32_t checked_alignment(const Entry& entry) const {
    const std::uint64_t alignment = number_of(entry);
    if (alignment == 0 || !std::has_single_bit(alignment) || alignment > 4096) {
      fail_at(entry.line, fmt::format("bad alignment {}", alignment));
    }
    return static_cast<std::uint32_t>(alignment);
  }

  FieldClassPtr parse_integer() {
    FieldClass integer;
    integer.is_big_endian = trace_.is_big_endian;
    integer.alignment = 0;
    for (const Entry& entry : parse_block()) {
      const std::string& text = entry.value.text;
      if (entry.name == "size") integer.size = static_cast<std::uint32_t>(number_of(entry));
      if (entry.name == "align") integer.alignment = checked_alignment(entry);
      if (entry.name == "signed")
        integer.is_signed = text.empty() ? entry.value.number != 0 : text == "true" || text == "TRUE";
      if (entry.name == "byte_order") integer.is_big_endian = is_big_endian(text, entry.line);
      if (entry.name == "encoding")
        integer.is_text = text == "UTF8" || text == "utf8" || text == "ASCII" || text == "ascii";
      if (entry.name == "base") integer.base = base_of(entry);
      if (entry.name == "map") integer.clock = clock_of(entry);
    }
    if (integer.size == 0 || integer.size > 64) fail(fmt::format("an integer of {} bits", integer.size));
    if (integer.alignment == 0) integer.alignment = integer.size % kByte == 0 ? kByte : 1;
    integer.access = access_of(integer);
    return std::make_shared<FieldClass>(std::move(integer));
  }

  static std::uint8_t base_of(const Entry& entry) {
    if (entry.value.kind == Value::Kind::kNumber) return static_cast<std::uint8_t>(entry.value.number);
    const std::string& name = entry.value.text;
    if (name == "hexadecimal" || name == "hex" || name == "x" || name == "X" || name == "p") return 16;
    if (name == "octal" || name == "oct" || name == "o") return 8;
    if (name == "binary" || name == "b") return 2;
    return 10;
  }

  // clock.NAME.value
  static std::string clock_of(const Entry& entry) {
    std::string_view path = entry.value.text;
    if (!path.starts_with("clock.") || !path.ends_with(".value")) fail_at(entry.line, "an integer has an unknown map");
    path.remove_prefix(6);
    path.remove_suffix(6);
    return std::string(path);
  }

  FieldClassPtr parse_real() {
    FieldClass real;
    real.kind = FieldKind::kReal;
    real.is_big_endian = trace_.is_big_endian;
    for (const Entry& entry : parse_block()) {
      if (entry.name == "exp_dig" || entry.name == "mant_dig")
        real.size += static_cast<std::uint32_t>(number_of(entry));
      if (entry.name == "align") real.alignment = checked_alignment(entry);
      if (entry.name == "byte_order") real.is_big_endian = is_big_endian(entry.value.text, entry.line);
    }
    if (real.size != 32 && real.size != 64) fail(fmt::format("a number of {} bits", real.size));
    return std::make_shared<FieldClass>(std::move(real));
  }

  FieldClassPtr parse_string() {
    if (peek(1).is("{")) {
      parse_block();
    } else {
      take();
    }
    FieldClass string;
    string.kind = FieldKind::kString;
    string.alignment = kByte;
    return std::make_shared<FieldClass>(std::move(string));
  }

  // `struct NAME`, `struct NAME {…} align(N)`, `struct {…}`
  FieldClassPtr parse_structure() {
    take();
    const std::string name = peek().kind == Token::Kind::kName ? "struct " + take().text : "";
    if (!peek().is("{")) return named(name);
    FieldClass structure;
    structure.kind = FieldKind::kStructure;
    structure.members = parse_members();
    if (take_if("align")) {
      expect("(");
      Entry alignment{"align", {}, nullptr, peek().line};
      alignment.value.number = parse_number();
      structure.alignment = checked_alignment(alignment);
      expect(")");
    }
    for (const FieldMember& member : structure.members) {
      structure.alignment = std::max(structure.alignment, member.type->alignment);
    }
    return declare(name, std::move(structure));
  }

  // `variant NAME <path>`, `variant <path> {…}`, `variant NAME {…}`
  FieldClassPtr parse_variant() {
    take();
    const std::string name = peek().kind == Token::Kind::kName ? "variant " + take().text : "";
    std::string path;
    if (take_if("<")) {
      path = parse_field_path();
      expect(">");
    }
    FieldClass variant;
    if (peek().is("{")) {
      variant.kind = FieldKind::kVariant;
      variant.members = parse_members();
    } else {
      variant = *named(name);
    }
    if (!path.empty()) variant.path = path;
    return declare(name, std::move(variant));
  }

  // `enum NAME`, `enum [NAME] [: type] {…}`
  FieldClassPtr parse_enumeration() {
    take();
    const std::string name = peek().kind == Token::Kind::kName ? "enum " + take().text : "";
    FieldClassPtr container;
    if (take_if(":")) container = parse_type();
    if (!peek().is("{")) return named(name);
    if (!container) container = known_type("int");
    if (!container || container->kind != FieldKind::kInteger) fail("an enumeration of an unknown integer");
    FieldClass enumeration = *container;
    enumeration.kind = FieldKind::kEnumeration;
    expect("{");
    std::int64_t next = 0;
    while (!take_if("}")) {
      if (peek().kind != Token::Kind::kName && peek().kind != Token::Kind::kString) fail("expected a label");
      EnumerationRange range{take().text, next, next};
      if (take_if("=")) {
        range.first = range.last = parse_number();
        if (take_if("...")) range.last = parse_number();
      }
      next = range.last + 1;
      enumeration.ranges.push_back(std::move(range));
      if (!peek().is("}")) expect(",");
    }
    return declare(name, std::move(enumeration));
  }

  FieldClassPtr named(const std::string& name) const {
    if (FieldClassPtr type = known_type(name)) return type;
    fail(fmt::format("unknown type '{}'", name));
  }

  FieldClassPtr declare(const std::string& name, FieldClass type) {
    auto declared = std::make_shared<FieldClass>(std::move(type));
    if (!name.empty()) scopes_.back().types[name] = declared;
    return declared;
  }

  std::vector<FieldMember> parse_members() {
    expect("{");
    scopes_.emplace_back();
    std::vector<FieldMember> members;
    while (!take_if("}")) {
      if (peek().kind == Token::Kind::kEnd) fail("a structure has no end");
      if (peek().is("typealias")) {
        parse_type_alias();
        continue;
      }
      const FieldClassPtr type = parse_type();
      do {
        members.push_back(parse_declarator(type));
      } while (take_if(","));
      expect(";");
    }
    scopes_.pop_back();
    return members;
  }

  // NAME, NAME[8], NAME[length], NAME[2][3]
  FieldMember parse_declarator(FieldClassPtr type) {
    if (peek().kind != Token::Kind::kName) fail(fmt::format("expected the name of a field, found '{}'", peek().text));
    FieldMember member{without_underscore(take().text), std::move(type)};
    std::vector<FieldClass> dimensions;
    while (take_if("[")) {
      FieldClass array;
      if (peek().kind == Token::Kind::kNumber) {
        array.kind = FieldKind::kArray;
        array.length = take().number;
      } else {
        array.kind = FieldKind::kSequence;
        array.path = parse_field_path();
      }
      expect("]");
      dimensions.push_back(std::move(array));
    }
    for (auto array = dimensions.rbegin(); array != dimensions.rend(); ++array) {
      array->alignment = member.type->alignment;
      array->element = std::move(member.type);
      member.type = std::make_shared<FieldClass>(std::move(*array));
    }
    return member;
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::vector<TypeScope> scopes_;
  TraceClass trace_;
};

}  // namespace

TraceClass parse_metadata(std::string_view text) {
  return Parser(text).parse();
}

}  // namespace tracing::ctf
