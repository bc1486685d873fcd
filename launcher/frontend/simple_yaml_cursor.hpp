// SPDX-License-Identifier: Apache-2.0
// A place in the text of a YAML file, and what is asked of the line that it stands in.
#pragma once

#include <cstddef>
#include <string_view>

namespace launch {

class SimpleYamlCursor {
 public:
  // Thrown for what is out of the ordinary (simple_yaml.hpp).
  struct GiveUp {};

 protected:
  static constexpr std::size_t kNoKey = std::string_view::npos;

  // The text must outlive the cursor.
  explicit SimpleYamlCursor(std::string_view text) : text_(text) {}

  char peek(std::size_t ahead = 0) const { return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0'; }
  bool at_flow() const { return peek() == '[' || peek() == '{'; }
  bool at_quote() const { return peek() == '"' || peek() == '\''; }
  bool at_dash() const { return peek() == '-' && (peek(1) == ' ' || peek(1) == '\n'); }
  // Where the colon of the "KEY:" that begins here stands, kNoKey where none does. A quoted key is only recognised;
  // what is in its quotes is looked at when it is read.
  std::size_t colon_of_key() const;
  bool is_key() const { return colon_of_key() != kNoKey; }
  // Where the plain text that begins here ends in a block: before blanks, and before a comment.
  std::size_t plain_end() const;

  // Whether the character there ends what is before it: a blank, the end of the line, the end of the text.
  bool is_end(std::size_t at) const { return at >= text_.size() || text_[at] == ' ' || text_[at] == '\n'; }

  void skip_blanks() {
    while (peek() == ' ') {
      ++position_;
    }
  }
  // From anywhere behind a node: blanks and a comment up to the end of the line.
  void end_line();
  // From the end of a line, or the beginning of the text, to the first character of the next line that has content.
  void next_line();

  const std::string_view text_;
  std::size_t position_ = 0;
  std::size_t column_ = 0;  // of the line's first character, where next_line() has stopped
};

}  // namespace launch
