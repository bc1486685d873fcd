// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/xml_pieces.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace launch {

namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

class PieceReader {
 public:
  explicit PieceReader(std::string_view text) : text_(text) {}

  std::vector<XmlPiece> read() {
    std::vector<XmlPiece> pieces;
    while (true) {
      const std::size_t begin = std::min(text_.find_first_not_of(kXmlBlanks, at_), text_.size());
      const std::string_view blanks = text_.substr(at_, begin - at_);
      at_ = begin;
      if (at_ == text_.size()) {
        return pieces;
      }
      XmlPiece piece = next();
      piece.text = text_.substr(begin, at_ - begin);
      if (piece.kind == XmlPiece::Kind::kText) {
        const std::size_t end = piece.text.find_last_not_of(kXmlBlanks) + 1;
        at_ = begin + end;
        piece.text = piece.text.substr(0, end);
      }
      piece.line_ends_before = static_cast<std::size_t>(std::count(blanks.begin(), blanks.end(), '\n'));
      pieces.push_back(std::move(piece));
    }
  }

 private:
  bool at(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  void move_behind(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }

  XmlPiece next() {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kSections = {
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
    for (const auto& [begin, end] : kSections) {
      if (at(begin)) {
        const XmlPiece::Kind kind = begin == "<!--" ? XmlPiece::Kind::kComment : XmlPiece::Kind::kOther;
        at_ += begin.size();
        move_behind(end);
        return {.kind = kind};
      }
    }
    if (at("<!")) {
      doctype();
      return {.kind = XmlPiece::Kind::kOther};
    }
    if (at("</")) {
      at_ += 2;
      const std::string_view name = take_name();
      move_behind(">");
      return {.kind = XmlPiece::Kind::kEnd, .name = name};
    }
    if (at("<")) {
      return tag();
    }
    at_ = std::min(text_.find('<', at_), text_.size());
    return {.kind = XmlPiece::Kind::kText};
  }

  // It ends behind the bracket of its declarations.
  void doctype() {
    const std::size_t bracket = text_.find('[', at_);
    if (bracket < text_.find('>', at_)) {
      at_ = bracket;
      move_behind("]");
    }
    move_behind(">");
  }

  std::string_view take_name() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n=/>", at_), text_.size());
    const std::size_t begin = std::exchange(at_, end);
    return text_.substr(begin, end - begin);
  }

  XmlPiece tag() {
    ++at_;
    XmlPiece piece{.kind = XmlPiece::Kind::kStart, .name = take_name()};
    while (true) {
      at_ = std::min(text_.find_first_not_of(kXmlBlanks, at_), text_.size());
      if (at_ == text_.size() || at(">")) {
        at_ = std::min(at_ + 1, text_.size());
        return piece;
      }
      if (at("/")) {
        piece.kind = XmlPiece::Kind::kEmpty;
        move_behind(">");
        return piece;
      }
      XmlPiece::Attribute attribute{.name = take_name()};
      const std::size_t quote = std::min(text_.find_first_of("\"'", at_), text_.size());
      if (quote == text_.size()) {
        at_ = text_.size();
        return piece;
      }
      attribute.quote = text_[quote];
      const std::size_t end = std::min(text_.find(attribute.quote, quote + 1), text_.size());
      attribute.value = text_.substr(quote + 1, end - quote - 1);
      at_ = std::min(end + 1, text_.size());
      piece.attributes.push_back(attribute);
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<XmlPiece> xml_pieces(std::string_view text) {
  return PieceReader(text).read();
}

}  // namespace launch
