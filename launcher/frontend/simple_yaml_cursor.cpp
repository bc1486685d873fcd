// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/simple_yaml_cursor.hpp"

#include <algorithm>

namespace launch {

namespace {

constexpr std::size_t kMaximumKey = 500;  // YAML ends the search for the ':' of a key somewhere behind

}  // namespace

std::size_t SimpleYamlCursor::colon_of_key() const {
  if (at_flow()) {
    return kNoKey;
  }
  std::size_t at = position_;
  if (at_quote()) {
    at = text_.find(peek(), position_ + 1);
    if (at == std::string_view::npos || text_.substr(at + 1, 1) != ":") {
      return kNoKey;
    }
  }
  const std::size_t last = std::min(text_.size(), position_ + kMaximumKey);
  for (; at < last && text_[at] != '\n'; ++at) {
    if (text_[at] == ':' && is_end(at + 1)) {
      return at;
    }
    if (text_[at] == ' ' && at + 1 < last && text_[at + 1] == '#') {
      return kNoKey;
    }
  }
  return kNoKey;
}

std::size_t SimpleYamlCursor::plain_end() const {
  std::size_t end = position_;
  for (std::size_t at = position_; at < text_.size() && text_[at] != '\n'; ++at) {
    if (text_[at] == ' ') {
      if (at + 1 < text_.size() && text_[at + 1] == '#') {
        break;
      }
      continue;
    }
    if (text_[at] == ':' && is_end(at + 1)) {
      throw GiveUp();
    }
    end = at + 1;
  }
  if (end == position_) {
    throw GiveUp();
  }
  return end;
}

void SimpleYamlCursor::end_line() {
  const std::size_t begin = position_;
  skip_blanks();
  if (peek() == '#' && (position_ > begin || begin == 0 || text_[begin - 1] == '\n' || text_[begin - 1] == ' ')) {
    position_ = std::min(text_.find('\n', position_), text_.size());
  }
  if (position_ < text_.size() && text_[position_] != '\n') {
    throw GiveUp();
  }
}

void SimpleYamlCursor::next_line() {
  while (position_ < text_.size()) {
    position_ += peek() == '\n' ? 1 : 0;
    const std::size_t begin = position_;
    skip_blanks();
    if (position_ < text_.size() && peek() != '#' && peek() != '\n') {
      column_ = position_ - begin;
      return;
    }
    end_line();
  }
  column_ = 0;
}

}  // namespace launch
