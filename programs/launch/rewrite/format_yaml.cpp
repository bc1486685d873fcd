// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/yaml_block_tokens.hpp"

namespace launch {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view without_end(std::string_view line) {
  return line.substr(0, line.find_last_not_of(kBlanks) + 1);
}

// A collection in brackets on one line, as {name: x, value: 1}.
std::string tidy_flow(std::string_view text) {
  std::string result;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      result += c;
      if (c == '\\' && quote == '"' && i + 1 < text.size()) {
        result += text[++i];
      } else if (c == quote) {
        quote = '\0';
      }
      continue;
    }
    const char before = result.empty() ? ' ' : result.back();
    if (begins_quoted(text, i)) {
      quote = c;
    }
    if (c == ' ') {
      const std::size_t next = text.find_first_not_of(' ', i);
      const bool is_last =
          next == std::string_view::npos || text[next] == ',' || text[next] == ']' || text[next] == '}';
      const bool is_extra = before == '{' || before == '[' || before == ' ' || is_last;
      // Blanks inside of a plain text are a part of it.
      const bool is_inside = std::string_view("{[,: ").find(before) == std::string_view::npos && !is_last;
      if (is_inside) {
        result += text.substr(i, next - i);
        i = next - 1;
      } else if (!is_extra) {
        result += ' ';
      }
      continue;
    }
    result += c;
    if (c == ',' && i + 1 < text.size() && std::string_view(" ,]}").find(text[i + 1]) == std::string_view::npos) {
      result += ' ';
    }
  }
  return result;
}

class YamlWriter {
 public:
  explicit YamlWriter(const std::shared_ptr<const SourceFile>& file)
      : text_(file->text()), blocks_(yaml_blocks(file)) {}

  std::string write() {
    std::size_t at = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    while (at < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      line(at, text_.substr(at, end - at));
      at = end + 1;
    }
    return std::move(result_);
  }

 private:
  struct Level {
    std::size_t before;  // the column in the given text
    std::size_t now;
  };

  static bool holds(const std::vector<YamlSpan>& spans, std::size_t at) {
    return std::any_of(spans.begin(), spans.end(),
                       [&](const YamlSpan& span) { return span.begin < at && at < span.end; });
  }

  void line(std::size_t begin, std::string_view line) {
    const bool continues_text = holds(blocks_.scalars, begin);
    if (continues_text || holds(blocks_.flows, begin)) {
      continuation(continues_text ? line : without_end(line));
      return;
    }
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
      blank_ = !result_.empty();
      return;
    }
    if (blank_) {
      result_ += '\n';
      blank_ = false;
    }
    const std::size_t line_end = begin + line.size();
    if (next_ < blocks_.tokens.size() && blocks_.tokens[next_].begin < line_end) {
      tokens(begin, line_end);
    } else if (line[first] == '#') {
      result_.append(column_of_comment(first), ' ').append(without_end(line.substr(first))).append("\n");
    } else if (line.starts_with("---") || line.starts_with("...") || line.starts_with('%')) {
      result_.append(without_end(line)).append("\n");
    } else {
      continuation(without_end(line));
    }
  }

  // A line of a text or a collection that has begun above moves with it.
  void continuation(std::string_view line) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    if (blanks == line.size()) {
      result_.append(line).append("\n");
      return;
    }
    const Level level = levels_.empty() ? Level{0, 0} : levels_.back();
    const std::size_t column = blanks + level.now > level.before ? blanks + level.now - level.before : 0;
    result_.append(column, ' ').append(line.substr(blanks)).append("\n");
  }

  void tokens(std::size_t begin, std::size_t line_end) {
    bool is_first = true;
    std::size_t at = begin;
    while (next_ < blocks_.tokens.size() && blocks_.tokens[next_].begin < line_end) {
      const YamlBlockToken& token = blocks_.tokens[next_++];
      if (is_first) {
        result_.append(token.column, ' ');
        is_first = false;
      } else {
        // What stands between two tokens of a line: the blanks behind a dash, or an anchor.
        const std::string_view between = text_.substr(at, token.begin - at);
        const std::size_t word = between.find_first_not_of(kBlanks);
        result_ += word == std::string_view::npos ? " " : " " + std::string(without_end(between.substr(word))) + " ";
      }
      const std::size_t column = token.begin - begin;
      while (!levels_.empty() && levels_.back().before >= column) {
        levels_.pop_back();
      }
      levels_.push_back({column, token.column});
      if (token.kind == YamlBlockToken::Kind::kKey) {
        result_.append(without_end(text_.substr(token.begin, token.end - 1 - token.begin))).append(":");
      } else {
        result_ += '-';
      }
      at = token.end;
    }
    rest(at, line_end);
    result_ += '\n';
  }

  // What stands behind the last key or dash of a line.
  void rest(std::size_t at, std::size_t line_end) {
    const std::string_view given = text_.substr(at, line_end - at);
    const std::size_t first = given.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
      return;
    }
    if (given[first] == '#') {
      result_ += without_end(given);
      return;
    }
    result_ += ' ';
    const std::string_view value = given.substr(first);
    const std::size_t begin = at + first;
    const auto flow = std::find_if(blocks_.flows.begin(), blocks_.flows.end(),
                                   [&](const YamlSpan& span) { return span.begin == begin && span.end <= line_end; });
    if (flow == blocks_.flows.end()) {
      result_ += ends_in_text(line_end) ? value : without_end(value);
      return;
    }
    result_ += tidy_flow(text_.substr(flow->begin, flow->end - flow->begin));
    result_ += without_end(text_.substr(flow->end, line_end - flow->end));
  }

  bool ends_in_text(std::size_t line_end) const { return holds(blocks_.scalars, line_end); }

  // A comment belongs to the line below it, or to the level around it that it stands at.
  std::size_t column_of_comment(std::size_t column) const {
    const std::optional<Level> next = next_level();
    if (next && next->before == column) {
      return next->now;
    }
    const auto level =
        std::find_if(levels_.begin(), levels_.end(), [&](const Level& each) { return each.before == column; });
    if (level != levels_.end()) {
      return level->now;
    }
    return next ? next->now : levels_.empty() ? 0 : levels_.back().now;
  }

  std::optional<Level> next_level() const {
    if (next_ == blocks_.tokens.size()) {
      return std::nullopt;
    }
    const YamlBlockToken& token = blocks_.tokens[next_];
    return Level{token.begin - (text_.rfind('\n', token.begin) + 1), token.column};  // npos + 1 is 0
  }

  std::string_view text_;
  YamlBlocks blocks_;
  std::size_t next_ = 0;       // the next token
  std::vector<Level> levels_;  // of the last line with tokens
  bool blank_ = false;         // blank lines were passed over
  std::string result_;
};

}  // namespace

std::string formatted_yaml(const std::shared_ptr<const SourceFile>& file) {
  return YamlWriter(file).write();
}

}  // namespace launch
