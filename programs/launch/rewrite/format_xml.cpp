// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/utf8.hpp"
#include "programs/launch/rewrite/declared_element.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/xml_pieces.hpp"

namespace launch {

namespace {

constexpr std::size_t kIndent = 2;

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// Where the attribute stands in a tag: the package first, then as the reference has it, then what the reference does
// not have, then the condition.
std::size_t rank(std::string_view name, const DeclaredElement& declared) {
  constexpr std::size_t kUnknown = 1000;
  if (name == "pkg") {
    return 0;
  }
  if (name == "if" || name == "unless") {
    return kUnknown + 1;
  }
  const AttributeSpec* const found = declared.attribute(name);
  return found == nullptr ? kUnknown : static_cast<std::size_t>(found - declared.attributes->data()) + 1;
}

class XmlWriter {
 public:
  XmlWriter(std::string_view text, const Registry& registry)
      : text_(text), registry_(registry), pieces_(xml_pieces(text)) {}

  std::string write() {
    around_.emplace_back();
    for (next_ = 0; next_ < pieces_.size(); ++next_) {
      piece(pieces_[next_]);
    }
    return result_ + "\n";
  }

 private:
  void piece(const XmlPiece& piece) {
    if (piece.kind == XmlPiece::Kind::kEnd) {
      around_.pop_back();
      begin_line(false);
      result_ += "</" + std::string(piece.name) + ">";
      return;
    }
    const bool trails = piece.kind == XmlPiece::Kind::kComment && piece.line_ends_before == 0 && next_ > 0;
    if (trails) {
      result_ += ' ';
    } else {
      const bool is_first_inside = next_ > 0 && pieces_[next_ - 1].kind == XmlPiece::Kind::kStart;
      begin_line(piece.line_ends_before > 1 && !is_first_inside);
    }
    if (piece.kind == XmlPiece::Kind::kStart || piece.kind == XmlPiece::Kind::kEmpty) {
      tag(piece);
    } else {
      verbatim(piece.text);
    }
  }

  std::size_t indent() const { return (around_.size() - 1) * kIndent; }

  void begin_line(bool blank_before) {
    if (!result_.empty()) {
      result_ += blank_before ? "\n\n" : "\n";
    }
    line_begin_ = result_.size();
    result_.append(indent(), ' ');
  }

  std::size_t column() const { return characters(std::string_view(result_).substr(line_begin_)); }

  // Later lines keep their distance from the first one.
  void verbatim(std::string_view text) {
    const auto offset = static_cast<std::size_t>(text.data() - text_.data());
    const std::size_t line = text_.rfind('\n', offset);
    const std::size_t before = characters(text_.substr(line + 1, offset - line - 1));  // npos + 1 is 0
    const std::size_t now = column();
    while (true) {
      const std::size_t end = text.find('\n');
      std::string_view first = text.substr(0, end);
      result_ += end == std::string_view::npos ? first : first.substr(0, first.find_last_not_of(" \t") + 1);
      if (end == std::string_view::npos) {
        return;
      }
      text.remove_prefix(end + 1);
      const std::size_t blanks = std::min(text.find_first_not_of(" \t"), text.size());
      const bool is_blank = blanks == text.size() || text[blanks] == '\n';
      text.remove_prefix(blanks);
      result_ += '\n';
      line_begin_ = result_.size();
      result_.append(is_blank ? 0 : blanks + now > before ? blanks + now - before : 0, ' ');
    }
  }

  void tag(const XmlPiece& piece) {
    const bool closes = piece.kind == XmlPiece::Kind::kStart && next_ + 1 < pieces_.size() &&
                        pieces_[next_ + 1].kind == XmlPiece::Kind::kEnd;
    const DeclaredElement declared =
        around_.size() == 1 ? declared_root() : declared_in(around_.back(), piece.name, registry_);
    std::vector<XmlPiece::Attribute> attributes = piece.attributes;
    std::stable_sort(attributes.begin(), attributes.end(), [&](const auto& left, const auto& right) {
      return rank(left.name, declared) < rank(right.name, declared);
    });
    result_ += '<' + std::string(piece.name);
    const std::string_view end = closes || piece.kind == XmlPiece::Kind::kEmpty ? "/>" : ">";
    const std::size_t first_column = column() + 1;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      const XmlPiece::Attribute& attribute = attributes[i];
      const char quote = attribute.value.find('"') == std::string_view::npos ? '"' : '\'';
      const std::string text = std::string(attribute.name) + '=' + quote + std::string(attribute.value) + quote;
      const std::string_view first_line = std::string_view(text).substr(0, text.find('\n'));
      const std::size_t behind = i + 1 == attributes.size() && first_line.size() == text.size() ? end.size() : 0;
      if (i > 0 && column() + 1 + characters(first_line) + behind > kFormattedColumns) {
        result_ += '\n';
        line_begin_ = result_.size();
        result_.append(first_column, ' ');
      } else {
        result_ += ' ';
      }
      result_ += text;
      if (const std::size_t line = text.rfind('\n'); line != std::string::npos) {
        line_begin_ = result_.size() - (text.size() - line - 1);
      }
    }
    result_ += end;
    if (closes) {
      ++next_;
    } else if (piece.kind == XmlPiece::Kind::kStart) {
      around_.push_back(declared);
    }
  }

  std::string_view text_;
  const Registry& registry_;
  std::vector<XmlPiece> pieces_;
  std::size_t next_ = 0;
  std::vector<DeclaredElement> around_;  // of the open elements; the first one is the place outside all
  std::string result_;
  std::size_t line_begin_ = 0;  // of the last line of the result
};

}  // namespace

std::string formatted_xml(std::string_view text, const Registry& registry) {
  const bool has_mark = text.starts_with("\xEF\xBB\xBF");
  return XmlWriter(has_mark ? text.substr(3) : text, registry).write();
}

}  // namespace launch
