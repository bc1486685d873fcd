// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/text/ascii.hpp"
#include "base/text/utf8.hpp"
#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

// tinyxml2 refuses a depth of 100.
constexpr std::size_t kMaximumXmlDepth = 90;

class XmlScanner : private XmlCursor {
 public:
  explicit XmlScanner(const std::shared_ptr<const SourceFile>& source) : XmlCursor(source) {}

  XmlScan scan() {
    prolog();
    while (position < text.size() && !stopped) {
      content();
    }
    for (; !open_.empty(); open_.pop_back()) {
      never_closed(fmt::format("add </{}>", open_.back().name()));
    }
    if (root_.empty() && errors.empty()) {
      error("the file holds no element", rest(), "expected <launch> ... </launch>");
    }
    separate_line_ends();
    return {file, std::move(readable_), root_, std::move(entities), std::move(errors)};
  }

 private:
  struct OpenElement {
    std::string_view tag;         // "<name"
    std::size_t first_attribute;  // its index in attributes_

    std::string_view name() const { return tag.substr(1); }
  };

  // A piece of the file that goes from one mark to another.
  struct Section {
    std::string_view begin;
    std::string_view end;
    std::size_t search;  // where the search for the end begins
    const char* what;
    void (XmlScanner::*check)(std::string_view section);
  };

  void prolog() {
    position = at(kByteOrderMark) ? kByteOrderMark.size() : 0;
    const std::string_view mark = "<?xml";
    if (at(mark) && rest().size() > mark.size() && is_xml_blank(rest()[mark.size()])) {
      read_xml_declaration(*this);
    }
    const auto size = static_cast<std::uint32_t>(text.size());
    if (std::optional<Diagnostic> bad =
            stopped ? std::nullopt : find_bad_character(LocatedText(file->text(), {file, 0, size}))) {
      errors.push_back(std::move(*bad));
      stopped = true;
    }
    readable_ = text;
  }

  void content() {
    static constexpr std::array<Section, 3> kSections = {{
        {"<!--", "-->", 4, "comment", &XmlScanner::check_comment},
        {"<![CDATA[", "]]>", 9, "CDATA section", &XmlScanner::check_cdata},
        {"<?", "?>", 0, "processing instruction", &XmlScanner::check_instruction},
    }};
    if (!at("<")) {
      character_data();
    } else if (position + 1 < text.size() && begins_xml_name(text[position + 1])) {
      start_tag();
    } else if (at("</")) {
      end_tag();
    } else if (at("<!DOCTYPE")) {
      doctype();
    } else if (const auto* section = std::find_if(kSections.begin(), kSections.end(),
                                                  [this](const Section& each) { return at(each.begin); });
               section != kSections.end()) {
      read_section(*section);
    } else {
      error("'<' starts no tag here", rest().substr(0, 1), "write &lt; for the character itself");
      ++position;
    }
  }

  void character_data() {
    const std::size_t begin = position;
    position = std::min(text.find('<', begin), text.size());
    const std::string_view run = from(begin);
    if (open_.empty()) {
      const std::string_view words = trim(run);
      if (!words.empty()) {
        error("text outside the root element", words.substr(0, words.find('\n')),
              "remove it, or make it a comment: <!-- ... -->");
      }
      return;
    }
    check_references(run);
    if (const std::size_t i = run.find("]]>"); i != std::string_view::npos) {
      error("']]>' in text", run.substr(i, 3), "write ]]&gt;");
    }
  }

  void read_section(const Section& section) {
    const std::size_t begin = position;
    const std::size_t end = text.find(section.end, begin + section.search);
    if (end == std::string_view::npos) {
      fatal(fmt::format("the {} is not closed", section.what), rest().substr(0, section.begin.size()),
            fmt::format("add '{}' at its end", section.end));
      return;
    }
    position = end + section.end.size();
    (this->*section.check)(from(begin));
  }

  void check_comment(std::string_view comment) {
    const std::size_t dashes = comment.find("--", 4);
    if (dashes + 3 < comment.size()) {
      error("'--' inside a comment", comment.substr(dashes, 2), "XML allows it only as part of '-->'");
    }
  }

  void check_cdata(std::string_view cdata) {
    if (open_.empty()) {
      error("text outside the root element", cdata.substr(0, 9));
    }
  }

  // tinyxml2 refuses processing instructions inside the root.
  void check_instruction(std::string_view instruction) {
    const std::string_view target = leading_xml_name(instruction.substr(2));
    const std::string_view data = instruction.substr(2 + target.size());
    if (target.empty() || (data != "?>" && !is_xml_blank(data.front()))) {
      error("a processing instruction needs a name", instruction.substr(0, 2));
    } else if (target == "xml" || target == "XML" || target == "Xml") {
      error("the XML declaration must stand at the very start of the file", instruction.substr(0, 2 + target.size()),
            "remove what stands before it, blank lines too");
    }
    hide(instruction);
  }

  // tinyxml2 ends a DOCTYPE at the first '>'.
  void doctype() {
    const std::size_t begin = position;
    const std::string_view mark = text.substr(begin, 9);
    int brackets = 0;
    for (position += mark.size(); position < text.size(); ++position) {
      const char c = text[position];
      if (at("<!--")) {
        position = std::min(text.find("-->", position), text.size());
      } else if (c == '"' || c == '\'') {
        position = std::min(text.find(c, position + 1), text.size());
      } else if (c == '[' || c == ']') {
        brackets += c == '[' ? 1 : -1;
      } else if (c == '>' && brackets == 0) {
        ++position;
        hide(from(begin));
        entities = declared_entities(from(begin));
        if (!root_.empty() || has_doctype) {
          error("a DOCTYPE must stand once, before the root element", mark);
        }
        has_doctype = true;
        return;
      }
    }
    fatal("the DOCTYPE is not closed", mark, "add '>' at its end");
  }

  void hide(std::string_view part) {
    const auto begin = readable_.begin() + (part.data() - text.data());
    std::replace_if(
        begin, begin + static_cast<std::ptrdiff_t>(part.size()), [](char c) { return c != '\n'; }, ' ');
  }

  // tinyxml2 takes "\n\r" for one line end. In XML it is two line ends.
  void separate_line_ends() {
    for (std::size_t i = readable_.find("\n\r"); i != std::string::npos; i = readable_.find("\n\r", i + 1)) {
      readable_[i + 1] = readable_.compare(i + 2, 1, "\n") == 0 ? '\r' : '\n';
    }
  }

  void start_tag() {
    const std::size_t begin = position++;
    take_name();
    const OpenElement element{from(begin), attributes_.size()};
    if (open_.empty() && !root_.empty()) {
      error(fmt::format("a second root element <{}>", element.name()), element.name(),
            "an XML file has one root element; put this one inside it");
    }
    const bool is_closed = read_attributes(element);
    if (stopped) {
      return;
    }
    root_ = root_.empty() ? element.name() : root_;
    check_prefix(element.name());
    for (std::size_t i = element.first_attribute; i < attributes_.size(); ++i) {
      check_prefix(attributes_[i]);
    }
    if (is_closed) {
      last_self_closed_ = element.name();
      attributes_.resize(element.first_attribute);
      return;
    }
    open_.push_back(element);
    if (open_.size() > kMaximumXmlDepth) {
      fatal(fmt::format("elements are nested more than {} levels deep", kMaximumXmlDepth), from(begin));
    }
  }

  // Reads the attributes of a start tag and its end. True if the tag ends with "/>".
  bool read_attributes(const OpenElement& element) {
    while (true) {
      const bool blank = skip_blanks();
      if (position == text.size()) {
        fatal(fmt::format("the tag <{}> is not closed", element.name()), element.tag, "add '>' or '/>' at its end");
        return false;
      }
      if (at(">") || at("/>")) {
        const bool is_closed = at("/");
        position += is_closed ? 2 : 1;
        return is_closed;
      }
      const std::string_view name = take_name();
      if (name.empty()) {
        unexpected_in(element);
        return skip_tag();
      }
      if (!blank) {
        error(fmt::format("no white space before the attribute '{}'", name), name,
              attributes_.size() == element.first_attribute ? "" : "is a quote missing before it?");
        return skip_tag();
      }
      if (!read_attribute(element, name)) {
        return !stopped && skip_tag();
      }
    }
  }

  void unexpected_in(const OpenElement& element) {
    if (at("<")) {
      error(fmt::format("the tag <{}> is not closed", element.name()), element.tag,
            fmt::format("add '>' or '/>' before the '<' on line {}", place_of(rest()).line));
      return;
    }
    const std::string_view character = rest().substr(0, decode_utf8(rest()).size);
    error(fmt::format("unexpected '{}' in the tag <{}>", character, element.name()), character,
          "expected an attribute, '>' or '/>'");
  }

  // Moves behind the tag after an error in it, so that the rest of the file is checked, too.
  bool skip_tag() {
    position = std::min(text.find_first_of("<>", position), text.size());
    if (!at(">")) {
      return true;
    }
    ++position;
    return text[position - 2] == '/';
  }

  // Reads what stands behind the name of an attribute. False if the rest of the tag can't be read.
  bool read_attribute(const OpenElement& element, std::string_view name) {
    const XmlAttributeValue value = take_value();
    if (!value.has_equals_sign) {
      error(fmt::format("the attribute '{}' of <{}> has no value", name, element.name()), name,
            fmt::format("write {}=\"...\"", name));
      return false;
    }
    if (value.quote == '\0') {
      error(fmt::format("the value of the attribute '{}' must stand in quotes", name), rest().substr(0, 1));
      return false;
    }
    if (!value.is_closed) {
      fatal(fmt::format("the value of the attribute '{}' is not closed", name), rest().substr(0, 1),
            fmt::format("add {} at its end", value.quote));
      return false;
    }
    if (const std::size_t less = value.text.find('<'); less != std::string_view::npos) {
      error(fmt::format("'<' in the value of the attribute '{}'", name), value.text.substr(less, 1),
            fmt::format("write &lt; for the character, or add the quote {} that is missing before it", value.quote));
      const bool is_quote_missing = position < text.size() && !is_xml_blank(text[position]) && !at(">") && !at("/>");
      if (is_quote_missing) {
        stopped = true;
        return false;
      }
    }
    check_references(value.text);
    const auto same =
        std::find(attributes_.begin() + static_cast<std::ptrdiff_t>(element.first_attribute), attributes_.end(), name);
    if (same != attributes_.end()) {
      const SourceFile::Position first = place_of(*same);
      error(fmt::format("duplicate attribute '{}' of <{}>", name, element.name()), name,
            fmt::format("it was given first at line {}, column {}", first.line, first.column));
    }
    attributes_.push_back(name);
    return true;
  }

  void end_tag() {
    const std::size_t begin = position;
    position += 2;
    const std::string_view name = take_name();
    const std::string_view tag = from(begin);
    skip_blanks();
    if (name.empty() || !at(">")) {
      error(fmt::format("the closing tag </{}> is malformed", name), tag, "write </NAME>");
      position = std::min(text.find_first_of("<>", position), text.size());
    }
    position += at(">") ? 1 : 0;
    close(name);
  }

  void close(std::string_view name) {
    const auto has_name = [&](const OpenElement& element) { return element.name() == name; };
    if (std::any_of(open_.begin(), open_.end(), has_name)) {
      for (; open_.back().name() != name; open_.pop_back()) {
        never_closed(fmt::format("add </{}> before </{}> on line {}", open_.back().name(), name, place_of(name).line));
      }
    } else if (!open_.empty() && !did_you_mean(name, {std::string(open_.back().name())}).empty()) {
      error(fmt::format("closing tag </{}> does not match <{}>", name, open_.back().name()), name,
            fmt::format("<{}> was opened on line {}", open_.back().name(), place_of(open_.back().tag).line));
    } else {
      error(fmt::format("closing tag </{}> without an opening tag", name), name,
            !name.empty() && last_self_closed_ == name
                ? fmt::format("the tag <{}> on line {} is already closed by its '/>'", name,
                              place_of(last_self_closed_).line)
                : "");
      return;
    }
    attributes_.resize(open_.back().first_attribute);
    open_.pop_back();
  }

  void never_closed(std::string help) {
    error(fmt::format("<{}> is never closed", open_.back().name()), open_.back().tag, std::move(help));
  }

  // A name like "a:b" needs xmlns:a on its element or on an enclosing element.
  void check_prefix(std::string_view name) {
    const std::size_t colon = name.find(':');
    if (colon == std::string_view::npos || name.starts_with("xml:") || name.starts_with("xmlns:")) {
      return;
    }
    const std::string_view prefix = name.substr(0, colon);
    const std::string declaration = fmt::format("xmlns:{}", prefix);
    if (std::find(attributes_.begin(), attributes_.end(), declaration) == attributes_.end()) {
      error(fmt::format("the namespace prefix '{}' is not declared", prefix), name,
            fmt::format("add {}=\"...\" to the element, or drop the prefix", declaration));
    }
  }

  std::string readable_;
  std::string_view root_;
  std::vector<OpenElement> open_;
  std::vector<std::string_view> attributes_;  // the names of all attributes of the open elements
  std::string_view last_self_closed_;
};

}  // namespace

XmlScan scan_xml(const std::shared_ptr<const SourceFile>& file) {
  return XmlScanner(file).scan();
}

}  // namespace launch
