// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/tsdl_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

void fail_at_line(std::size_t line, const std::string& what) {
  throw UnsupportedTrace(fmt::format("metadata, line {}: {}", line, what));
}

std::string without_underscore(const std::string& name) {
  return name.size() > 1 && name[0] == '_' ? name.substr(1) : name;
}

const Token& TsdlCursor::peek(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

const Token& TsdlCursor::take() {
  const Token& token = peek();
  if (at_ + 1 < tokens_.size()) {
    ++at_;
  }
  return token;
}

bool TsdlCursor::take_if(std::string_view text) {
  if (!peek().is(text)) {
    return false;
  }
  take();
  return true;
}

void TsdlCursor::expect(std::string_view text) {
  if (!take_if(text)) {
    fail(fmt::format("expected '{}', found '{}'", text, peek().text));
  }
}

std::string TsdlCursor::take_path() {
  if (!at_name()) {
    fail(fmt::format("expected a name, found '{}'", peek().text));
  }
  std::string path = take().text;
  while (take_if(".")) {
    path += "." + take().text;
  }
  return path;
}

std::string TsdlCursor::take_field_path() {
  if (!at_name()) {
    fail(fmt::format("expected a field, found '{}'", peek().text));
  }
  std::string path = without_underscore(take().text);
  while (take_if(".")) {
    path += "." + without_underscore(take().text);
  }
  return path;
}

TsdlValue TsdlCursor::take_value() {
  TsdlValue value;
  if (peek().kind == Token::Kind::kString) {
    value.kind = TsdlValue::Kind::kString;
    while (peek().kind == Token::Kind::kString) {
      value.text += take().text;
    }
  } else if (at_name()) {
    value.kind = TsdlValue::Kind::kPath;
    value.text = take_path();
  } else {
    value.number = take_number();
  }
  return value;
}

std::int64_t TsdlCursor::take_number() {
  const bool negative = take_if("-");
  if (!negative) {
    take_if("+");
  }
  if (peek().kind != Token::Kind::kNumber) {
    fail(fmt::format("expected a number, found '{}'", peek().text));
  }
  const std::uint64_t number = take().number;
  return static_cast<std::int64_t>(negative ? 0 - number : number);
}

}  // namespace tracing::ctf
