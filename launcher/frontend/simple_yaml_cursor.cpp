#include "launcher/frontend/simple_yaml_cursor.hpp"

#include <algorithm>

namespace launch {

namespace {

constexpr std::size_t kMaximumKey = 500;  // YAML ends the search for the ':' of a key somewhere behind

}  // namespace

bool SimpleYamlCursor::is_key() const {
  if (at_flow()) {
    return false;
  }
  const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = text_.substr(position_, line_end - position_);
  std::size_t from = 0;
  if (peek() == '"' || peek() == '\'') {
    from = line.find(peek(), 1);
    if (from == std::string_view::npos || from + 1 >= line.size() || line[from + 1] != ':') {
      return false;
    }
  }
  const std::size_t colon = line.find(": ", from);
  const bool at_end = colon == std::string_view::npos && line.ends_with(':');
  const std::size_t end = at_end ? line.size() - 1 : colon;
  return end != std::string_view::npos && end < std::min(line.find(" #"), kMaximumKey);
}

std::size_t SimpleYamlCursor::plain_end() const {
  const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
  const std::size_t comment = text_.substr(0, line_end).find(" #", position_);
  const std::size_t end = std::min(comment, line_end);
  const std::string_view line = text_.substr(position_, end - position_);
  const std::size_t colon = line.find(": ");
  const std::size_t last = line.find_last_not_of(' ');
  if (colon != std::string_view::npos || last == std::string_view::npos || line[last] == ':') {
    throw GiveUp();
  }
  return position_ + last + 1;
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
