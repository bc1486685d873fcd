// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/comments.hpp"

#include <algorithm>
#include <string_view>

#include "programs/launch/rewrite/xml_pieces.hpp"
#include "programs/launch/rewrite/yaml_block_tokens.hpp"

namespace launch {

namespace {

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

// Where a comment begins in a line without texts over several lines; npos: nowhere.
std::size_t comment_in(std::string_view line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char before = i == 0 ? ' ' : line[i - 1];
    if (quote != '\0') {
      i += line[i] == '\\' && quote == '"' ? 1 : 0;
      quote = i < line.size() && line[i] == quote ? '\0' : quote;
    } else if (begins_quoted(line, i)) {
      quote = line[i];
    } else if (line[i] == '#' && (before == ' ' || before == '\t')) {
      return i;
    }
  }
  return std::string_view::npos;
}

}  // namespace

Comments::Comments(const std::shared_ptr<const SourceFile>& file) {
  const std::string& text = file->text();
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first != std::string::npos && text[first] == '<') {
    read_xml(*file);
  } else {
    read_yaml(file);
  }
}

void Comments::add(std::size_t at, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = without_blanks(text.substr(0, end));
    if (!line.empty()) {
      lines_.push_back({at, std::string(line), false});
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void Comments::read_xml(const SourceFile& file) {
  const std::string_view text = file.text();
  for (const XmlPiece& piece : xml_pieces(text)) {
    const auto at = static_cast<std::size_t>(piece.text.data() - text.data());
    if (piece.line_ends_before > 1 && piece.kind != XmlPiece::Kind::kEnd) {
      lines_.push_back({at, "", true});
    }
    if (piece.kind == XmlPiece::Kind::kComment) {
      constexpr std::size_t kBegin = 4;
      constexpr std::size_t kMarks = 7;
      add(at, piece.text.substr(kBegin, piece.text.size() - kMarks));
    }
  }
}

void Comments::read_yaml(const std::shared_ptr<const SourceFile>& file) {
  const std::string_view text = file->text();
  const YamlBlocks blocks = yaml_blocks(file);
  const auto in_text = [&](std::size_t at) {
    return std::any_of(blocks.scalars.begin(), blocks.scalars.end(),
                       [&](const YamlSpan& span) { return span.begin < at && at < span.end; });
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (!in_text(at)) {
      if (without_blanks(line).empty()) {
        lines_.push_back({at, "", true});
      } else if (const std::size_t mark = comment_in(line); mark != std::string_view::npos) {
        add(at + mark, line.substr(mark + 1));
      }
    }
    at = end + 1;
  }
}

std::vector<std::string> Comments::take_before(std::size_t offset) {
  std::vector<std::string> found;
  while (next_ < lines_.size() && lines_[next_].at <= offset) {
    const Line& line = lines_[next_++];
    if (!line.is_blank || found.empty() || !found.back().empty()) {
      found.push_back(line.text);
    }
  }
  return found;
}

std::vector<std::string> Comments::take_rest() {
  std::vector<std::string> found = take_before(static_cast<std::size_t>(-1));
  while (!found.empty() && found.back().empty()) {
    found.pop_back();
  }
  return found;
}

}  // namespace launch
