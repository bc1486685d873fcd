// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/xml_cursor.hpp"

namespace launch {

namespace {

// tinyxml2 stops at 100.
constexpr std::size_t kMaximumDepth = 90;

class XmlScanner : private XmlCursor {
 public:
  using XmlCursor::XmlCursor;

  XmlScan scan() {
    prolog();
    while (position < text.size() && !stopped) {
      content();
    }
    if (!stopped) {
      finish();
    }
    scan_.errors = std::move(errors);
    return std::move(scan_);
  }

 private:
  struct Open {
    std::string name;
    std::size_t begin;                  // of the tag, its "<"
    std::vector<std::string> prefixes;  // that it declares by xmlns:prefix
  };

  void prolog() {
    if (at(kByteOrderMark)) {
      position = kByteOrderMark.size();
    }
    if (at("<?xml") && position + 5 < text.size() && is_xml_blank(text[position + 5])) {
      read_xml_declaration(*this);
    }
    if (!latin1 && !stopped) {
      if (std::optional<Diagnostic> bad = find_bad_character(LocatedText(file->text(), range(0, text.size())))) {
        errors.push_back(std::move(*bad));
        stopped = true;
      }
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
    const std::size_t end = std::min(text.find('<', begin), text.size());
    position = end;
    const std::string_view run = text.substr(begin, end - begin);
    if (open_.empty()) {
      const std::size_t first = run.find_first_not_of(kXmlBlanks);
      if (first != std::string_view::npos) {
        const std::size_t last = std::min(run.find('\n', first), run.find_last_not_of(kXmlBlanks) + 1);
        error("text outside the root element", begin + first, begin + last,
              "remove it, or make it a comment: <!-- ... -->");
      }
      return;
    }
    for (std::size_t i = run.find('&'); i != std::string_view::npos; i = run.find('&', i + 1)) {
      decode_xml_reference(*this, begin + i, end);
    }
    if (const std::size_t i = run.find("]]>"); i != std::string_view::npos) {
      error("']]>' in text", begin + i, begin + i + 3, "write ]]&gt;");
    }
  }

  void comment() {
    const std::size_t begin = position;
    const std::size_t dashes = text.find("--", begin + 4);
    const std::size_t end = text.find("-->", begin + 4);
    if (end == std::string_view::npos) {
      fatal("the comment is not closed", begin, begin + 4, "add '-->' at its end");
      return;
    }
    if (dashes < end) {
      error("'--' inside a comment", dashes, dashes + 2, "XML allows it only as part of '-->'");
    }
    position = end + 3;
  }

  void cdata() {
    const std::size_t begin = position;
    const std::size_t end = text.find("]]>", begin);
    if (end == std::string_view::npos) {
      fatal("the CDATA section is not closed", begin, begin + 9, "add ']]>' at its end");
      return;
    }
    if (open_.empty()) {
      error("text outside the root element", begin, begin + 9);
    }
    position = end + 3;
  }

  void processing_instruction() {
    const std::size_t begin = position;
    const std::size_t end = text.find("?>", begin);
    if (end == std::string_view::npos) {
      fatal("the processing instruction is not closed", begin, begin + 2, "add '?>' at its end");
      return;
    }
    position = begin + 2;
    const std::string_view target = take_name();
    if (target.empty() || (position != end && !is_xml_blank(text[position]))) {
      error("a processing instruction needs a name", begin, begin + 2);
    } else if (target == "xml" || target == "XML" || target == "Xml") {
      error("the XML declaration must stand at the very start of the file", begin, begin + 2 + target.size(),
            "remove what stands before it, blank lines too");
    }
    position = end + 2;
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
        if (has_root_ || has_doctype) {
          error("a DOCTYPE must stand once, before the root element", begin, begin + 9);
        }
        has_doctype = true;
        return;
      }
    }
    fatal("the DOCTYPE is not closed", begin, begin + 9, "add '>' at its end");
  }

  void start_tag() {
    const std::size_t begin = position++;
    XmlTag tag;
    tag.name = take_name();
    tag.where = range(begin + 1, position);
    if (open_.empty() && std::exchange(has_root_, true)) {
      error(fmt::format("a second root element <{}>", tag.name), begin + 1, position,
            "an XML file has one root element; put this one inside it");
    }
    const bool closed = read_xml_attributes(*this, tag, begin);
    if (stopped) {
      return;
    }
    scan_.markup.append("<").append(tag.name).append(closed ? "/>" : ">");
    Open element{tag.name, begin, declared_prefixes(tag)};
    check_prefixes(tag, element);
    scan_.tags.push_back(std::move(tag));
    if (closed) {
      last_self_closed_ = std::move(element);
      return;
    }
    open_.push_back(std::move(element));
    if (open_.size() > kMaximumDepth) {
      fatal(fmt::format("elements are nested more than {} levels deep", kMaximumDepth), begin, position);
    }
  }

  void end_tag() {
    const std::size_t begin = position;
    position += 2;
    const std::string name(take_name());
    const std::size_t name_end = position;
    skip_blanks();
    if (name.empty() || !at(">")) {
      error(fmt::format("the closing tag </{}> is malformed", name), begin, name_end, "write </NAME>");
      position = std::min(text.find_first_of("<>", position), text.size());
    }
    if (at(">")) {
      ++position;
    }
    const auto match =
        std::find_if(open_.rbegin(), open_.rend(), [&](const Open& element) { return element.name == name; });
    if (match != open_.rend()) {
      for (; open_.back().name != name; open_.pop_back()) {
        never_closed(open_.back(),
                     fmt::format("add </{}> before </{}> on line {}", open_.back().name, name, line(begin)));
      }
      scan_.markup.append("</").append(name).append(">");
      open_.pop_back();
    } else if (!open_.empty() && !did_you_mean(name, {open_.back().name}).empty()) {
      error(fmt::format("closing tag </{}> does not match <{}>", name, open_.back().name), begin + 2, name_end,
            fmt::format("<{}> was opened on line {}", open_.back().name, line(open_.back().begin)));
      open_.pop_back();
    } else {
      const bool already_closed = last_self_closed_ && last_self_closed_->name == name;
      error(fmt::format("closing tag </{}> without an opening tag", name), begin + 2, name_end,
            already_closed ? fmt::format("the tag <{}> on line {} is already closed by its '/>'", name,
                                         line(last_self_closed_->begin))
                           : "");
    }
  }

  void never_closed(const Open& element, std::string help) {
    error(fmt::format("<{}> is never closed", element.name), element.begin, element.begin + 1 + element.name.size(),
          std::move(help));
  }

  void finish() {
    for (; !open_.empty(); open_.pop_back()) {
      never_closed(open_.back(), fmt::format("add </{}>", open_.back().name));
    }
    if (!has_root_ && errors.empty()) {
      error("the file holds no element", text.size(), text.size(), "expected <launch> ... </launch>");
    }
  }

  static std::vector<std::string> declared_prefixes(const XmlTag& tag) {
    constexpr std::string_view kDeclaration = "xmlns:";
    std::vector<std::string> prefixes;
    for (const Attribute& attribute : tag.attributes) {
      if (attribute.name.starts_with(kDeclaration)) {
        prefixes.push_back(attribute.name.substr(kDeclaration.size()));
      }
    }
    return prefixes;
  }

  // A name like "a:b" needs xmlns:a on its element or on an enclosing one.
  void check_prefixes(const XmlTag& tag, const Open& element) {
    const auto check = [&](const std::string& name, const SourceRange& where) {
      const std::size_t colon = name.find(':');
      if (colon == std::string::npos || name.starts_with("xml:") || name.starts_with("xmlns:")) {
        return;
      }
      const std::string prefix = name.substr(0, colon);
      const auto declares = [&](const Open& open) {
        return std::find(open.prefixes.begin(), open.prefixes.end(), prefix) != open.prefixes.end();
      };
      if (!declares(element) && std::none_of(open_.begin(), open_.end(), declares)) {
        error(fmt::format("the namespace prefix '{}' is not declared", prefix), where.begin, where.end,
              fmt::format("add xmlns:{}=\"...\" to the element, or drop the prefix", prefix));
      }
    };
    check(tag.name, tag.where);
    for (const Attribute& attribute : tag.attributes) {
      check(attribute.name, attribute.name_where);
    }
  }

  std::vector<Open> open_;
  std::optional<Open> last_self_closed_;
  bool has_root_ = false;
  XmlScan scan_;
};

}  // namespace

XmlScan scan_xml(const std::shared_ptr<const SourceFile>& file) {
  return XmlScanner(file).scan();
}

}  // namespace launch
