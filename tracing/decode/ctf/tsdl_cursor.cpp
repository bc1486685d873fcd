// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/tsdl_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

namespace {

bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool continues_name(char c) {
  return starts_name(c) || is_digit(c);
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  Token next() {
    skip_space();
    Token token;
    token.line = line_;
    if (at_ == text_.size()) {
      return token;
    }
    const char c = text_[at_];
    if (starts_name(c)) {
      token.kind = Token::Kind::kName;
      token.text = take_while(continues_name);
    } else if (is_digit(c)) {
      token.kind = Token::Kind::kNumber;
      token.text = take_while(continues_name);  // with a suffix such as ULL
      token.number = number_of(token.text);
    } else if (c == '"') {
      token.kind = Token::Kind::kString;
      token.text = string();
    } else {
      token.kind = Token::Kind::kSymbol;
      token.text = symbol();
    }
    return token;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw UnsupportedTrace(fmt::format("metadata, line {}: {}", line_, what));
  }

  void skip_space() {
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("/*") || rest.starts_with("//")) {
        const std::string_view end = rest[1] == '*' ? "*/" : "\n";
        const std::size_t found = rest.find(end, 2);
        const std::size_t length = found == std::string_view::npos ? rest.size() : found + end.size();
        line_ += static_cast<std::size_t>(std::count(rest.begin(), rest.begin() + static_cast<long>(length), '\n'));
        at_ += length;
      } else if (rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\r' || rest[0] == '\n' || rest[0] == '\0') {
        if (rest[0] == '\n') {
          ++line_;
        }
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string take_while(bool (*belongs)(char)) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && belongs(text_[at_])) {
      ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::uint64_t number_of(std::string_view text) const {
    while (!text.empty() && (text.back() == 'U' || text.back() == 'u' || text.back() == 'L' || text.back() == 'l')) {
      text.remove_suffix(1);
    }
    int base = 10;
    if (text.starts_with("0x") || text.starts_with("0X")) {
      base = 16;
      text.remove_prefix(2);
    } else if (text.size() > 1 && text.starts_with('0')) {
      base = 8;
    }
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail(fmt::format("'{}' is not a number", text));
    }
    return value;
  }

  std::string string() {
    std::string result;
    for (++at_; at_ < text_.size(); ++at_) {
      char c = text_[at_];
      if (c == '"') {
        ++at_;
        return result;
      }
      if (c == '\\' && at_ + 1 < text_.size()) {
        c = text_[++at_];
        if (c == 'n') {
          c = '\n';
        }
        if (c == 't') {
          c = '\t';
        }
      } else if (c == '\n') {
        ++line_;
      }
      result += c;
    }
    fail("a string has no end");
  }

  std::string symbol() {
    constexpr std::array<std::string_view, 2> kLong{"...", ":="};
    for (const std::string_view symbol : kLong) {
      if (text_.substr(at_).starts_with(symbol)) {
        at_ += symbol.size();
        return std::string(symbol);
      }
    }
    constexpr std::string_view kSingle = "{}[]()<>;:,=.+-*";
    if (kSingle.find(text_[at_]) == std::string_view::npos) {
      fail(fmt::format("unexpected '{}'", text_[at_]));
    }
    return std::string(1, text_[at_++]);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace

std::vector<Token> tsdl_tokens(std::string_view text) {
  Scanner scanner(text);
  std::vector<Token> tokens;
  do {
    tokens.push_back(scanner.next());
  } while (tokens.back().kind != Token::Kind::kEnd);
  return tokens;
}

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
