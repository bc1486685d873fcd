// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_scalar_place.hpp"

#include <algorithm>

#include "base/text/utf8.hpp"

namespace launch {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_break(char c) {
  return c == '\n' || c == '\r';
}

// Walks through the source and the decoded text side by side. It stops at a difference that it does not know. The rest
// of the text then gets the place where it has stopped.
class ScalarLocator {
 public:
  ScalarLocator(const LocatedText& source, std::size_t begin, std::string_view decoded)
      : source_(source), raw_(source.text()), position_(begin), rest_(decoded) {}

  YamlScalarPlace locate() {
    bool closed = true;
    skip_properties();
    const char first = peek();
    if (first == '"' || first == '\'') {
      ++position_;
      result_ = LocatedText({}, source_.range(position_, 0));
      flow(first);
      closed = !reaches_end();
      position_ += closed ? 1 : 0;
    } else if (first == '|' || first == '>') {
      block(first == '>');
    } else {
      result_ = LocatedText({}, source_.range(position_, 0));
      flow('\0');
    }
    if (!rest_.empty()) {
      take(rest_.size(), 0);
    }
    return {std::move(result_), position_, closed};
  }

 private:
  char peek(std::size_t ahead = 0) const { return position_ + ahead < raw_.size() ? raw_[position_ + ahead] : '\0'; }

  // The next `size` bytes of the decoded text stand for the next `raw_size` bytes of the source.
  void take(std::size_t size, std::size_t raw_size) {
    const SourceRange range = source_.range(position_, raw_size);
    if (size == raw_size && range.end - range.begin != size) {  // it has an XML entity: locate each byte alone
      for (std::size_t i = 0; i < size; ++i) {
        const SourceRange byte = source_.range(position_ + i, 1);
        result_.append(rest_.substr(i, 1), byte.begin, byte.end);
      }
    } else {
      result_.append(rest_.substr(0, size), range.begin, range.end);
    }
    rest_.remove_prefix(size);
    position_ += raw_size;
  }

  void skip_properties() {
    while (peek() == '&' || peek() == '!') {
      while (position_ < raw_.size() && !is_blank(peek()) && !is_break(peek())) {
        ++position_;
      }
      while (is_blank(peek()) || is_break(peek())) {
        ++position_;
      }
    }
  }

  // Plain scalars (quote is '\0') and quoted scalars. Their lines are folded.
  void flow(char quote) {
    while (!rest_.empty() && position_ < raw_.size()) {
      const char c = peek();
      if (is_blank(c) || is_break(c)) {
        if (!fold()) {
          return;
        }
      } else if (quote == '"' && c == '\\') {
        escape();
      } else if (quote == '\'' && c == '\'' && peek(1) == '\'') {
        take(1, 2);
      } else if (c == rest_.front()) {
        take_equal();
      } else {
        return;
      }
    }
  }

  // Call this after a quoted text. True if only blanks follow, so that the closing quote is missing.
  bool reaches_end() {
    while (is_blank(peek()) || is_break(peek()) || (peek() == '\\' && is_break(peek(1)))) {
      ++position_;
    }
    return position_ >= raw_.size();
  }

  // Takes a run of equal bytes, up to a byte that may need decoding.
  void take_equal() {
    std::size_t size = 1;
    while (size < rest_.size() && peek(size) == rest_[size] && !is_blank(rest_[size]) && !is_break(rest_[size]) &&
           rest_[size] != '\\' && rest_[size] != '\'') {
      ++size;
    }
    take(size, size);
  }

  // Takes blanks. On one line they are kept. One line break becomes a space. Of several line breaks, all but one
  // remain.
  bool fold() {
    std::size_t raw_size = 0;
    std::size_t breaks = 0;
    while (is_blank(peek(raw_size)) || is_break(peek(raw_size))) {
      breaks += peek(raw_size) == '\n' ? 1 : 0;
      ++raw_size;
    }
    const std::size_t size = breaks == 0 ? raw_size : std::max<std::size_t>(breaks - 1, 1);
    if (size > rest_.size() || !std::all_of(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size),
                                            [](char c) { return is_blank(c) || is_break(c); })) {
      return false;
    }
    take(size, raw_size);
    return true;
  }

  void escape() {
    const char kind = peek(1);
    if (is_break(kind)) {  // the line goes on: the break and the indentation have no decoded text
      ++position_;
      while (is_blank(peek()) || is_break(peek())) {
        ++position_;
      }
      return;
    }
    const std::size_t raw_size = kind == 'x' ? 4 : kind == 'u' ? 6 : kind == 'U' ? 10 : 2;
    take(decode_utf8(rest_).size, std::min(raw_size, raw_.size() - position_));
  }

  // Literal and folded block scalars. The indentation of their lines has no decoded text.
  void block(bool folded) {
    const std::size_t header_end = std::min(raw_.find('\n', position_), raw_.size());
    position_ = std::min(header_end + 1, raw_.size());
    const std::size_t content = std::min(raw_.find_first_not_of(" \r\n", position_), raw_.size());
    const std::size_t line_begin = raw_.rfind('\n', content) + 1;
    const std::size_t indentation = content - line_begin;
    result_ = LocatedText({}, source_.range(content, 0));
    while (!rest_.empty() && position_ < raw_.size()) {
      for (std::size_t i = 0; i < indentation && peek() == ' '; ++i) {
        ++position_;
      }
      while (!rest_.empty() && position_ < raw_.size() && peek() == rest_.front() && peek() != '\n') {
        take(1, 1);
      }
      if (peek() == '\r') {
        ++position_;
      }
      if (peek() != '\n') {
        return;
      }
      if (!rest_.empty() && (rest_.front() == '\n' || (folded && rest_.front() == ' '))) {
        take(1, 1);
      } else {
        ++position_;  // this break has no decoded text: an empty line follows, or it was clipped at the end
      }
    }
  }

  const LocatedText& source_;
  std::string_view raw_;
  std::size_t position_;
  std::string_view rest_;
  LocatedText result_;
};

// Whether the scalar is plain and on one line, so that source and decoded text are equal. Most scalars are.
bool is_verbatim(std::string_view raw, std::string_view decoded) {
  const char first = raw.empty() ? '"' : raw.front();
  return first != '"' && first != '\'' && first != '|' && first != '>' && first != '!' && first != '&' &&
         raw.starts_with(decoded);
}

}  // namespace

YamlScalarPlace locate_yaml_scalar(const LocatedText& source, std::size_t begin, std::string_view decoded) {
  if (is_verbatim(std::string_view(source.text()).substr(begin), decoded)) {
    const SourceRange range = source.range(begin, decoded.size());
    if (range.end - range.begin == decoded.size()) {  // it has no XML entity
      return {LocatedText(std::string(decoded), range), begin + decoded.size()};
    }
  }
  return ScalarLocator(source, begin, decoded).locate();
}

}  // namespace launch
