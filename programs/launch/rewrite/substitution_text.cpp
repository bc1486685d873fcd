// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/substitution_text.hpp"

#include <algorithm>
#include <utility>

#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

using Pieces = std::vector<SubstitutionText>;

class PiecesReader {
 public:
  explicit PiecesReader(std::string_view text) : text_(text) {}

  // Up to a character that `ends` accepts; text in which a backslash stands before it goes on.
  template <typename Ends>
  Pieces read(Ends ends, char quote) {
    Pieces pieces;
    while (position_ < text_.size()) {
      std::size_t end = position_;
      while (end < text_.size() && !(ends(text_[end]) && !is_escaped(end)) && !begins_call(end)) {
        ++end;
      }
      if (end > position_) {
        pieces.push_back({unescape(text_.substr(position_, end - position_)), {}});
      }
      position_ = end;
      if (end == text_.size() || !begins_call(end)) {
        break;
      }
      pieces.push_back({{}, {call(quote)}});
    }
    return pieces;
  }

 private:
  bool is_escaped(std::size_t at) const { return at > 0 && text_[at - 1] == '\\'; }
  bool begins_call(std::size_t at) const { return text_.substr(at).starts_with("$(") && !is_escaped(at); }

  SubstitutionCall call(char quote) {
    position_ += 2;
    const std::size_t end = std::min(text_.find_first_of(" )", position_), text_.size());
    SubstitutionCall call{std::string(text_.substr(position_, end - position_)), {}};
    position_ = end;
    while (position_ < text_.size() && text_[position_] == ' ') {
      ++position_;
      const char next = position_ < text_.size() ? text_[position_] : '\0';
      if (quote == '\0' && (next == '"' || next == '\'')) {
        ++position_;
        call.arguments.push_back(read([next](char c) { return c == next; }, next));
        ++position_;
      } else {
        call.arguments.push_back(read(
            [quote](char c) {
              return c == ' ' || c == '(' || c == ')' || (quote == '\0' ? c == '\'' || c == '"' : c == quote);
            },
            quote));
      }
    }
    ++position_;
    return call;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace

std::vector<SubstitutionText> substitution_texts(std::string_view text) {
  return PiecesReader(text).read([](char /*c*/) { return false; }, '\0');
}

std::vector<std::vector<SubstitutionText>> command_words(std::string_view text) {
  std::vector<Pieces> words;
  bool open = false;  // a word has begun
  char quote = '\0';
  const auto add = [&](std::string_view more) {
    if (!std::exchange(open, true)) {
      words.emplace_back();
    }
    if (words.back().empty() || !words.back().back().call.empty()) {
      words.back().emplace_back();
    }
    words.back().back().words += more;
  };
  for (SubstitutionText& piece : substitution_texts(text)) {
    if (!piece.call.empty()) {
      add("");
      if (words.back().back().words.empty()) {
        words.back().pop_back();
      }
      words.back().push_back(std::move(piece));
      continue;
    }
    for (std::size_t i = 0; i < piece.words.size(); ++i) {
      const char c = piece.words[i];
      const bool has_next = i + 1 < piece.words.size();
      if (quote == '\0' && (c == ' ' || c == '\t' || c == '\n' || c == '\r')) {
        open = false;
      } else if (quote == '\0' && (c == '"' || c == '\'')) {
        quote = c;
        add("");
      } else if (c == quote) {
        quote = '\0';
      } else if (c == '\\' && has_next && quote == '\0') {
        add(piece.words.substr(++i, 1));
      } else if (c == '\\' && has_next && quote == '"' && (piece.words[i + 1] == '"' || piece.words[i + 1] == '\\')) {
        add(piece.words.substr(++i, 1));
      } else {
        add(std::string_view(&c, 1));
      }
    }
  }
  return words;
}

}  // namespace launch
