// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/idl_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

namespace {

constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kWord = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
constexpr std::string_view kSigns = "{}()[]<>;,=@:+-*/%|&^~";

std::size_t end_of_number(std::string_view text, std::size_t at) {
  if (text.substr(at).starts_with("0x") || text.substr(at).starts_with("0X")) {
    return std::min(text.find_first_not_of("0123456789abcdefABCDEF", at + 2), text.size());
  }
  const auto digits = [&](std::size_t from) { return std::min(text.find_first_not_of(kDigits, from), text.size()); };
  std::size_t end = digits(at);
  if (end < text.size() && text[end] == '.') {
    end = digits(end + 1);
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const bool has_sign = end + 1 < text.size() && (text[end + 1] == '+' || text[end + 1] == '-');
    end = digits(end + (has_sign ? 2 : 1));
  }
  const bool is_fixed_point = end < text.size() && (text[end] == 'd' || text[end] == 'D');
  return end + (is_fixed_point ? 1 : 0);
}

// The position after the closing quote; npos if there is none in the line.
std::size_t end_of_text(std::string_view text, std::size_t at) {
  for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == text[at]) {
      return i + 1;
    }
  }
  return text.npos;
}

}  // namespace

IdlTokens::IdlTokens(std::shared_ptr<const SourceFile> file) : file_(std::move(file)) {
  read(file_->text());
}

void IdlTokens::read(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    const std::string_view rest = text.substr(at);
    IdlToken token{IdlToken::Kind::kSign, {}, at};
    std::size_t end = at + 1;
    const bool is_wide = rest.starts_with("L\"") || rest.starts_with("L'");
    if (is_wide || std::string_view(" \t\r\n").find(c) != std::string_view::npos) {
      at = end;
      continue;
    }
    if (rest.starts_with("//") || c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (rest.starts_with("/*")) {
      const std::size_t close = text.find("*/", at + 2);
      if (close == text.npos) {
        fail({IdlToken::Kind::kSign, rest.substr(0, 2), at}, "the comment has no end");
      }
      at = close + 2;
      continue;
    }
    if (c == '"' || c == '\'') {
      token.kind = IdlToken::Kind::kText;
      end = end_of_text(text, at);
      if (end == text.npos) {
        fail({IdlToken::Kind::kSign, rest.substr(0, 1), at}, fmt::format("the string is not closed by {}", c));
      }
    } else if (kDigits.find(c) != kDigits.npos ||
               (c == '.' && end < text.size() && kDigits.find(text[end]) != kDigits.npos)) {
      token.kind = IdlToken::Kind::kNumber;
      end = end_of_number(text, at);
    } else if (kWord.find(c) != kWord.npos) {
      token.kind = IdlToken::Kind::kName;
      end = std::min(text.find_first_not_of(kWord, at), text.size());
    } else if (rest.starts_with("::") || rest.starts_with("<<")) {
      end = at + 2;
    } else if (kSigns.find(c) == kSigns.npos) {
      fail({IdlToken::Kind::kSign, rest.substr(0, 1), at}, fmt::format("'{}' has no meaning here", c));
    }
    token.text = text.substr(at, end - at);
    tokens_.push_back(token);
    at = end;
  }
  tokens_.push_back({IdlToken::Kind::kEnd, "the end of the file", text.size()});
}

IdlToken IdlTokens::take() {
  const IdlToken token = next();
  if (token.kind != IdlToken::Kind::kEnd) {
    ++at_;
  }
  return token;
}

bool IdlTokens::accept(std::string_view text) {
  const bool found =
      (next().kind == IdlToken::Kind::kName || next().kind == IdlToken::Kind::kSign) && next().text == text;
  at_ += found ? 1 : 0;
  return found;
}

void IdlTokens::expect(std::string_view text) {
  if (!accept(text)) {
    fail(next(), fmt::format("expected '{}' and not '{}'", text, next().text));
  }
}

std::string IdlTokens::take_name() {
  if (next().kind != IdlToken::Kind::kName) {
    fail(next(), fmt::format("expected a name and not '{}'", next().text));
  }
  return std::string(take().text);
}

void IdlTokens::fail(const IdlToken& token, std::string what, std::string help) const {
  throw LaunchError(std::move(what), range(token), std::move(help));
}

SourceRange IdlTokens::range(const IdlToken& token) const {
  const auto begin = static_cast<std::uint32_t>(token.begin);
  const std::size_t length = token.kind == IdlToken::Kind::kEnd ? 0 : token.text.size();
  return {file_, begin, begin + static_cast<std::uint32_t>(length)};
}

std::string unquoted(std::string_view text) {
  std::string result;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != '\\') {
      result += text[i];
      continue;
    }
    ++i;
    constexpr std::string_view kEscapes = "ntr";
    const std::size_t escape = kEscapes.find(text[i]);
    result += escape == kEscapes.npos ? text[i] : "\n\t\r"[escape];
  }
  return result;
}

}  // namespace launch
