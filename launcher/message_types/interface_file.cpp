// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/interface_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/message_types/read_value.hpp"

namespace launch {

namespace {

constexpr std::string_view kBlank = " \t\r";

// A '#' begins a comment unless it is in quotes. An apostrophe inside a word is no quote.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  bool escaped = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (escaped) {
      escaped = false;
    } else if (quote != 0) {
      escaped = c == '\\';
      quote = c == quote ? '\0' : quote;
    } else if (c == '#') {
      return line.substr(0, i);
    } else if ((c == '"' || c == '\'') && (i == 0 || std::string_view(" \t=,[").find(line[i - 1]) != line.npos)) {
      quote = c;
    }
  }
  return line;
}

class LineParser {
 public:
  LineParser(const std::shared_ptr<const SourceFile>& file, std::size_t begin, std::string_view text,
             const std::string& package, const FindMessage& find_message)
      : file_(file), begin_(begin), text_(text), package_(package), find_message_(find_message) {}

  void parse(MessageType& message) {
    skip_blanks();
    if (at_ == text_.size()) {
      return;
    }
    FieldType type = parse_type();
    skip_blanks();
    const std::size_t name_at = at_;
    at_ = std::min(text_.find_first_of(" \t\r=", at_), text_.size());
    const std::string name(text_.substr(name_at, at_ - name_at));
    if (name.empty()) {
      fail(name_at, 1, "the name is missing: a line is `type name` or `type NAME=value`");
    }
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '=') {
      ++at_;
      skip_blanks();
      MessageValue value = parse_value(type);
      message.constants.push_back({name, std::move(type), std::move(value)});
      return;
    }
    MessageValue value = at_ < text_.size() ? parse_value(type) : default_value(type);
    message.fields.push_back({name, std::move(type), std::move(value)});
  }

 private:
  [[noreturn]] void fail(std::size_t at, std::size_t length, std::string what) const {
    throw LaunchError(std::move(what), range(at, length));
  }
  SourceRange range(std::size_t at, std::size_t length) const {
    const auto from = static_cast<std::uint32_t>(begin_ + at);
    return {file_, from, from + static_cast<std::uint32_t>(length)};
  }
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(kBlank, at_), text_.size()); }

  std::size_t number(std::size_t at, std::string_view digits) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value == 0) {
      fail(at, std::max<std::size_t>(digits.size(), 1), "the size must be a number above 0");
    }
    return value;
  }

  FieldType parse_type() {
    const std::size_t at = at_;
    at_ = std::min(text_.find_first_of(kBlank, at_), text_.size());
    std::string_view word = text_.substr(at, at_ - at);
    FieldType type;
    if (const std::size_t bracket = word.find('['); bracket != word.npos) {
      parse_brackets(at + bracket, word.substr(bracket), type);
      word = word.substr(0, bracket);
    }
    if (const std::size_t bound = word.find("<="); bound != word.npos) {
      type.string_bound = number(at + bound + 2, word.substr(bound + 2));
      word = word.substr(0, bound);
    }
    if (const auto kind = primitive_kind(word)) {
      type.kind = *kind;
      return type;
    }
    type.kind = FieldKind::kMessage;
    std::string name(word);
    const auto slashes = std::count(name.begin(), name.end(), '/');
    if (slashes == 0) {
      name = fmt::format("{}/msg/{}", package_, name);
    } else if (slashes == 1) {
      name.insert(name.find('/'), "/msg");
    }
    try {
      type.message = find_message_(name);
    } catch (const LaunchError& error) {
      const Diagnostic& first = error.diagnostics().front();
      throw LaunchError(first.message, first.where ? first.where : range(at, word.size()), first.help);
    }
    return type;
  }

  void parse_brackets(std::size_t at, std::string_view brackets, FieldType& type) const {
    if (brackets.back() != ']') {
      fail(at, brackets.size(), fmt::format("'{}' is not an array: write [], [N] or [<=N]", brackets));
    }
    std::string_view size = brackets.substr(1, brackets.size() - 2);
    type.many = size.empty() || size.starts_with("<=") ? Many::kSequence : Many::kArray;
    size.remove_prefix(size.starts_with("<=") ? 2 : 0);
    type.count = brackets == "[]" ? 0 : number(at + 1, size);
  }

  MessageValue parse_value(const FieldType& type) {
    std::string_view rest = text_.substr(at_);
    rest = rest.substr(0, rest.find_last_not_of(kBlank) + 1);
    const bool is_text = type.kind == FieldKind::kString || type.kind == FieldKind::kWstring;
    if (is_text && type.many == Many::kOne && !rest.starts_with('"') && !rest.starts_with('\'')) {
      return {std::string(rest)};
    }
    return read_value(type, LocatedText(std::string(rest), range(at_, rest.size())));
  }

  const std::shared_ptr<const SourceFile>& file_;
  const std::size_t begin_;
  const std::string_view text_;
  const std::string& package_;
  const FindMessage& find_message_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<MessageType> parse_interface_file(const std::shared_ptr<const SourceFile>& file, const std::string& package,
                                              const FindMessage& find_message) {
  std::vector<MessageType> parts(1);
  const std::string_view text = file->text();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (line.starts_with("---") && line.find_first_not_of(kBlank, 3) == line.npos) {
      parts.emplace_back();
    } else {
      LineParser(file, begin, without_comment(line), package, find_message).parse(parts.back());
    }
    begin = end + 1;
  }
  return parts;
}

}  // namespace launch
