// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/read_xml_markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/xml_cursor.hpp"
#include "launcher/frontend/xml_nesting.hpp"

namespace launch {

namespace {

class MarkupReader : private XmlCursor {
 public:
  MarkupReader(const std::shared_ptr<const SourceFile>& file, XmlNesting* nesting)
      : XmlCursor(file), nesting_(nesting) {}

  XmlMarkup read() {
    prolog();
    while (position < text.size() && !stopped) {
      content();
    }
    doubt_if(markup.tags.empty());
    if (nesting_ != nullptr && !stopped) {
      nesting_->finish(*this);
    }
    return std::move(markup);
  }

 private:
  void prolog() {
    if (at(kByteOrderMark)) {
      position = kByteOrderMark.size();
    }
    if (at("<?xml") && position + 5 < text.size() && is_xml_blank(text[position + 5])) {
      read_xml_declaration(*this);
    }
    if (std::optional<Diagnostic> bad =
            stopped ? std::nullopt : find_bad_character(LocatedText(markup.file->text(), range(0, text.size())))) {
      markup.errors.push_back(std::move(*bad));
      stopped = true;
    }
  }

  void content() {
    if (!at("<")) {
      character_data();
    } else if (at("<!--")) {
      comment();
    } else if (at("<![CDATA[")) {
      cdata();
    } else if (at("<!DOCTYPE")) {
      doctype();
    } else if (at("<?")) {
      processing_instruction();
    } else if (at("</")) {
      end_tag();
    } else if (position + 1 < text.size() && is_xml_name_start(text[position + 1])) {
      start_tag();
    } else {
      error("'<' starts no tag here", position, position + 1, "write &lt; for the character itself");
      ++position;
    }
  }

  void character_data() {
    const std::size_t begin = position;
    position = std::min(text.find('<', begin), text.size());
    if (nesting_ != nullptr && nesting_->is_outside()) {
      nesting_->text_outside(*this, begin, position);
      return;
    }
    check_xml_references(*this, begin, position);
    const std::string_view run = text.substr(begin, position - begin);
    doubt_if(depth_ == 0 && run.find_first_not_of(kXmlBlanks) != std::string_view::npos);
    if (const std::size_t i = run.find("]]>"); i != std::string_view::npos) {
      error("']]>' in text", begin + i, begin + i + 3, "write ]]&gt;");
    }
  }

  // Moves behind the next `end`. If there is none, it adds an error at the first `size` bytes of the piece, and returns
  // false.
  bool skip_to(std::string_view end, const char* what, std::size_t from, std::size_t size) {
    const std::size_t found = text.find(end, from);
    if (found == std::string_view::npos) {
      fatal(fmt::format("the {} is not closed", what), position, position + size,
            fmt::format("add '{}' at its end", end));
      return false;
    }
    position = found + end.size();
    return true;
  }

  void comment() {
    const std::size_t begin = position;
    if (skip_to("-->", "comment", begin + 4, 4)) {
      const std::size_t dashes = text.find("--", begin + 4);
      if (dashes + 3 < position) {
        error("'--' inside a comment", dashes, dashes + 2, "XML allows it only as part of '-->'");
      }
    }
  }

  void cdata() {
    const std::size_t begin = position;
    doubt_if(depth_ == 0);
    if (skip_to("]]>", "CDATA section", begin, 9) && nesting_ != nullptr && nesting_->is_outside()) {
      error("text outside the root element", begin, begin + 9);
    }
  }

  void processing_instruction() {
    const std::size_t begin = position;
    if (!skip_to("?>", "processing instruction", begin, 2)) {
      return;
    }
    const std::size_t end = std::exchange(position, begin + 2);
    const std::string_view target = take_name();
    if (target.empty() || (position + 2 != end && !is_xml_blank(text[position]))) {
      error("a processing instruction needs a name", begin, begin + 2);
    } else if (target == "xml" || target == "XML" || target == "Xml") {
      error("the XML declaration must stand at the very start of the file", begin, begin + 2 + target.size(),
            "remove what stands before it, blank lines too");
    }
    position = end;
    hide(begin);
  }

  void doctype() {
    const std::size_t begin = position;
    int brackets = 0;
    char quote = '\0';
    for (position += 9; position < text.size(); ++position) {
      const char c = text[position];
      if (quote != '\0') {
        quote = c == quote ? '\0' : quote;
      } else if (at("<!--")) {
        position = std::min(text.find("-->", position), text.size());
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '[') {
        ++brackets;
      } else if (c == ']') {
        --brackets;
      } else if (c == '>' && brackets == 0) {
        ++position;
        hide(begin);
        if (nesting_ != nullptr && (nesting_->has_root() || markup.has_doctype)) {
          error("a DOCTYPE must stand once, before the root element", begin, begin + 9);
        }
        markup.has_doctype = true;
        doubt_if(true);
        return;
      }
    }
    fatal("the DOCTYPE is not closed", begin, begin + 9, "add '>' at its end");
  }

  void doubt_if(bool doubt) { markup.is_doubtful = markup.is_doubtful || doubt; }

  void hide(std::size_t begin) { markup.hidden.push_back(span(begin, position)); }

  void start_tag() {
    const std::size_t begin = position++;
    const std::string_view name = take_name();
    const XmlSpan where = span(begin + 1, position);
    doubt_if(depth_ == 0 && !markup.tags.empty());
    if (nesting_ != nullptr) {
      nesting_->begin_start_tag(*this, where);
    }
    const std::size_t first_attribute = markup.attribute_names.size();
    const bool closed = read_xml_attributes(*this, name, begin);
    if (stopped) {
      return;
    }
    markup.tags.push_back(where);
    depth_ += closed ? 0 : 1;
    doubt_if(name.find(':') != std::string_view::npos || depth_ > kMaximumXmlDepth);
    if (nesting_ != nullptr) {
      nesting_->end_start_tag(*this, first_attribute, closed);
    }
  }

  void end_tag() {
    const std::size_t begin = position;
    position += 2;
    const std::string_view name = take_name();
    const std::size_t name_end = position;
    skip_blanks();
    if (name.empty() || !at(">")) {
      error(fmt::format("the closing tag </{}> is malformed", name), begin, name_end, "write </NAME>");
      position = std::min(text.find_first_of("<>", position), text.size());
    }
    if (at(">")) {
      ++position;
    }
    doubt_if(depth_ == 0);
    depth_ -= depth_ == 0 ? 0 : 1;
    if (nesting_ != nullptr) {
      nesting_->end_tag(*this, span(begin + 2, name_end));
    }
  }

  XmlNesting* const nesting_;
  std::size_t depth_ = 0;  // correct only if the tags nest correctly
};

}  // namespace

XmlMarkup read_xml_markup(const std::shared_ptr<const SourceFile>& file, XmlNesting* nesting) {
  return MarkupReader(file, nesting).read();
}

}  // namespace launch
