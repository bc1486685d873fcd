// SPDX-License-Identifier: Apache-2.0
// The words of TSDL, the language of CTF 1.8's metadata, and a place in such a text. It takes what declarations consist
// of: words, names, numbers and values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tracing::ctf {

struct Token {
  enum class Kind : std::uint8_t { kName, kNumber, kString, kSymbol, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;          // of a string: without quotes, escapes resolved
  std::uint64_t number = 0;  // of a number
  std::size_t line = 1;

  bool is(std::string_view symbol_or_name) const {
    return (kind == Kind::kSymbol || kind == Kind::kName) && text == symbol_or_name;
  }
};

// The last token has the kind kEnd. Throws UnsupportedTrace.
std::vector<Token> tsdl_tokens(std::string_view text);

// The right side of `name = value;`.
struct TsdlValue {
  enum class Kind { kNumber, kString, kPath } kind = Kind::kNumber;
  std::string text;         // of a string; the names of a path, joined by dots
  std::int64_t number = 0;  // of a number
};

// Throws UnsupportedTrace with the line.
[[noreturn]] void fail_at_line(std::size_t line, const std::string& what);

// All functions that expect something throw UnsupportedTrace if something else stands at the cursor.
class TsdlCursor {
 public:
  explicit TsdlCursor(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  const Token& peek(std::size_t ahead = 0) const;
  bool at_name() const { return peek().kind == Token::Kind::kName; }
  std::size_t line() const { return peek().line; }

  const Token& take();
  bool take_if(std::string_view text);
  void expect(std::string_view text);
  std::string take_path();
  // The path of a field, made of the names that FieldMember has.
  std::string take_field_path();
  TsdlValue take_value();
  // Numbers beyond 63 bits keep their bits.
  std::int64_t take_number();

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(line(), what); }

 private:
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

// A name of a field as FieldMember has it.
std::string without_underscore(const std::string& name);

}  // namespace tracing::ctf
