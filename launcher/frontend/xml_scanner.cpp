#include "launcher/frontend/xml_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "launcher/base/utf8.hpp"
#include "launcher/frontend/input_text.hpp"

namespace launch {

namespace {

// A file that isn't XML at all would give an error for each of its characters.
constexpr std::size_t kMaximumErrors = 20;
// tinyxml2 stops at 100.
constexpr std::size_t kMaximumDepth = 90;

// Of versions and encoding names.
constexpr std::string_view kDeclarationCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._:-";

constexpr std::string_view kBlanks = " \t\r\n";

bool is_blank(char c) { return kBlanks.find(c) != std::string_view::npos; }
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool is_name_character(char c) { return is_name_start(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

bool is_xml_character(char32_t c) {
  return c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c <= 0xD7FF) || (c >= 0xE000 && c <= 0xFFFD) ||
         (c >= 0x10000 && c <= 0x10FFFF);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

class XmlScanner {
 public:
  explicit XmlScanner(const std::shared_ptr<const SourceFile>& file) : file_(file), text_(file->text()) {}

  XmlScan scan() {
    prolog();
    while (position_ < text_.size() && scan_.errors.size() < kMaximumErrors) {
      content();
    }
    if (scan_.errors.empty() || position_ >= text_.size()) {
      finish();
    }
    return std::move(scan_);
  }

 private:
  struct Open {
    std::string name;
    std::size_t begin;  // of the tag, its "<"
    std::vector<std::string> prefixes;  // that it declares by xmlns:prefix
  };

  SourceRange range(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  std::uint32_t line(std::size_t offset) const { return file_->position(offset).line; }
  std::string_view rest() const { return text_.substr(position_); }
  bool at(std::string_view what) const { return rest().starts_with(what); }

  void error(std::string message, std::size_t begin, std::size_t end, std::string help = {}) {
    if (scan_.errors.size() < kMaximumErrors) {
      scan_.errors.push_back({Severity::kError, std::move(message), range(begin, end), std::move(help)});
    }
  }
  void fatal(std::string message, std::size_t begin, std::size_t end, std::string help = {}) {
    error(std::move(message), begin, end, std::move(help));
    open_.clear();
    position_ = text_.size();
    stopped_ = true;
  }

  void prolog() {
    if (at(kByteOrderMark)) {
      position_ = kByteOrderMark.size();
    }
    if (at("<?xml") && position_ + 5 < text_.size() && is_blank(text_[position_ + 5])) {
      declaration();
    }
    if (!latin1_ && !stopped_) {
      if (std::optional<Diagnostic> bad = find_bad_character(LocatedText(file_->text(), range(0, text_.size())))) {
        scan_.errors.push_back(std::move(*bad));
        position_ = text_.size();
        stopped_ = true;
      }
    }
  }

  void declaration() {
    const std::size_t begin = position_;
    const std::size_t end = text_.find("?>", begin);
    if (end == std::string_view::npos) {
      fatal("the XML declaration is not closed", begin, begin + 5, "add '?>' at its end");
      return;
    }
    position_ = begin + 5;
    // Once each, in this order; only the version is required.
    constexpr std::array<std::string_view, 3> kNames = {"version", "encoding", "standalone"};
    std::size_t next = 0;
    while (skip_blanks(), position_ < end) {
      const std::size_t name_begin = position_;
      const std::string_view name = take_name();
      const auto known = std::find(kNames.begin() + static_cast<std::ptrdiff_t>(next), kNames.end(), name);
      skip_blanks();
      const bool equals = position_ < end && text_[position_] == '=';
      position_ += equals ? 1 : 0;
      skip_blanks();
      const char quote = position_ < end ? text_[position_] : '\0';
      const std::size_t close = quote == '"' || quote == '\'' ? text_.find(quote, position_ + 1) : std::string_view::npos;
      if (known == kNames.end() || !equals || close >= end || (next == 0 && name != "version")) {
        fatal("malformed XML declaration", name_begin, end, "write <?xml version=\"1.0\"?>");
        return;
      }
      const std::string_view value = text_.substr(position_ + 1, close - position_ - 1);
      if (value.empty() || value.find_first_not_of(kDeclarationCharacters) != std::string_view::npos) {
        fatal(fmt::format("malformed {} in the XML declaration", name), position_, close + 1);
        return;
      }
      if (name == "encoding") {
        encoding(position_ + 1, close);
      }
      next = static_cast<std::size_t>(known - kNames.begin()) + 1;
      position_ = close + 1;
    }
    if (next == 0) {
      fatal("the XML declaration lacks its version", begin, end + 2, "write <?xml version=\"1.0\"?>");
      return;
    }
    position_ = end + 2;
  }

  void encoding(std::size_t begin, std::size_t end) {
    const std::string name = lower(text_.substr(begin, end - begin));
    latin1_ = name == "iso-8859-1" || name == "latin-1" || name == "latin1";
    if (!latin1_ && name != "utf-8" && name != "utf8" && name != "us-ascii" && name != "ascii") {
      error(fmt::format("the encoding '{}' is not supported", text_.substr(begin, end - begin)), begin, end,
            "save the file as UTF-8");
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
    } else if (position_ + 1 < text_.size() && is_name_start(text_[position_ + 1])) {
      start_tag();
    } else {
      error("'<' starts no tag here", position_, position_ + 1, "write &lt; for the character itself");
      ++position_;
    }
  }

  void character_data() {
    const std::size_t begin = position_;
    const std::size_t end = std::min(text_.find('<', begin), text_.size());
    position_ = end;
    const std::string_view run = text_.substr(begin, end - begin);
    if (open_.empty()) {
      const std::size_t first = run.find_first_not_of(kBlanks);
      if (first != std::string_view::npos) {
        const std::size_t last = std::min(run.find('\n', first), run.find_last_not_of(kBlanks) + 1);
        error("text outside the root element", begin + first, begin + last, "remove it, or make it a comment: <!-- ... -->");
      }
      return;
    }
    for (std::size_t i = run.find('&'); i != std::string_view::npos; i = run.find('&', i + 1)) {
      reference(begin + i, end);
    }
    if (const std::size_t i = run.find("]]>"); i != std::string_view::npos) {
      error("']]>' in text", begin + i, begin + i + 3, "write ]]&gt;");
    }
  }

  void comment() {
    const std::size_t begin = position_;
    const std::size_t dashes = text_.find("--", begin + 4);
    const std::size_t end = text_.find("-->", begin + 4);
    if (end == std::string_view::npos) {
      fatal("the comment is not closed", begin, begin + 4, "add '-->' at its end");
      return;
    }
    if (dashes < end) {
      error("'--' inside a comment", dashes, dashes + 2, "XML allows it only as part of '-->'");
    }
    position_ = end + 3;
  }

  void cdata() {
    const std::size_t begin = position_;
    const std::size_t end = text_.find("]]>", begin);
    if (end == std::string_view::npos) {
      fatal("the CDATA section is not closed", begin, begin + 9, "add ']]>' at its end");
      return;
    }
    if (open_.empty()) {
      error("text outside the root element", begin, begin + 9);
    }
    position_ = end + 3;
  }

  void processing_instruction() {
    const std::size_t begin = position_;
    const std::size_t end = text_.find("?>", begin);
    if (end == std::string_view::npos) {
      fatal("the processing instruction is not closed", begin, begin + 2, "add '?>' at its end");
      return;
    }
    position_ = begin + 2;
    const std::string_view target = take_name();
    if (target.empty() || (position_ != end && !is_blank(text_[position_]))) {
      error("a processing instruction needs a name", begin, begin + 2);
    } else if (lower(target) == "xml") {
      error("the XML declaration must stand at the very start of the file", begin, begin + 2 + target.size(),
            "remove what stands before it, blank lines too");
    }
    position_ = end + 2;
  }

  void doctype() {
    const std::size_t begin = position_;
    int brackets = 0;
    char quote = '\0';
    for (position_ += 9; position_ < text_.size(); ++position_) {
      const char c = text_[position_];
      if (quote != '\0') {
        quote = c == quote ? '\0' : quote;
      } else if (at("<!--")) {
        position_ = std::min(text_.find("-->", position_), text_.size());
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '[') {
        ++brackets;
      } else if (c == ']') {
        --brackets;
      } else if (c == '>' && brackets == 0) {
        ++position_;
        if (has_root_ || has_doctype_) {
          error("a DOCTYPE must stand once, before the root element", begin, begin + 9);
        }
        has_doctype_ = true;
        return;
      }
    }
    fatal("the DOCTYPE is not closed", begin, begin + 9, "add '>' at its end");
  }

  void start_tag() {
    const std::size_t begin = position_++;
    XmlTag tag;
    tag.name = take_name();
    tag.where = range(begin + 1, position_);
    if (open_.empty() && std::exchange(has_root_, true)) {
      error(fmt::format("a second root element <{}>", tag.name), begin + 1, position_,
            "an XML file has one root element; put this one inside it");
    }
    const bool closed = attributes(tag, begin);
    if (stopped_) {
      return;
    }
    scan_.markup.append(text_.substr(begin, position_ - begin));
    Open element{tag.name, begin, declared_prefixes(tag)};
    check_prefixes(tag, element);
    scan_.tags.push_back(std::move(tag));
    if (closed) {
      last_self_closed_ = std::move(element);
      return;
    }
    open_.push_back(std::move(element));
    if (open_.size() > kMaximumDepth) {
      fatal(fmt::format("elements are nested more than {} levels deep", kMaximumDepth), begin, position_);
    }
  }

  // Reads up to the end of a start tag; true when it ends with "/>".
  bool attributes(XmlTag& tag, std::size_t tag_begin) {
    while (true) {
      const bool blank = skip_blanks();
      if (position_ >= text_.size()) {
        fatal(fmt::format("the tag <{}> is not closed", tag.name), tag_begin, tag_begin + 1 + tag.name.size(),
              "add '>' or '/>' at its end");
        return false;
      }
      if (at(">")) {
        ++position_;
        return false;
      }
      if (at("/>")) {
        position_ += 2;
        return true;
      }
      const std::size_t begin = position_;
      if (!is_name_start(text_[begin])) {
        unexpected_in_tag(tag, tag_begin);
        return skip_tag();
      }
      const std::string_view name = take_name();
      if (!blank) {
        error(fmt::format("no white space before the attribute '{}'", name), begin, position_,
              tag.attributes.empty() ? "" : "is a quote missing before it?");
        return skip_tag();
      }
      if (!attribute(tag, name, begin)) {
        return stopped_ ? false : skip_tag();
      }
    }
  }

  void unexpected_in_tag(const XmlTag& tag, std::size_t tag_begin) {
    if (at("<")) {
      error(fmt::format("the tag <{}> is not closed", tag.name), tag_begin, tag_begin + 1 + tag.name.size(),
            fmt::format("add '>' or '/>' before the '<' on line {}", line(position_)));
      return;
    }
    const CodePoint character = decode_utf8(rest());
    error(fmt::format("unexpected '{}' in the tag <{}>", rest().substr(0, character.size), tag.name), position_,
          position_ + character.size, "expected an attribute, '>' or '/>'");
  }

  // After an error inside a tag: goes on behind it, so that the rest of the file is checked, too.
  bool skip_tag() {
    const std::size_t end = text_.find_first_of("<>", position_);
    position_ = std::min(end, text_.size());
    if (!at(">")) {
      return true;
    }
    ++position_;
    return text_[position_ - 2] == '/';
  }

  // Reads "= value" and adds the attribute. False when the tag can't be read on.
  bool attribute(XmlTag& tag, std::string_view name, std::size_t begin) {
    const std::size_t name_end = position_;
    skip_blanks();
    if (!at("=")) {
      error(fmt::format("the attribute '{}' of <{}> has no value", name, tag.name), begin, name_end,
            fmt::format("write {}=\"...\"", name));
      return false;
    }
    ++position_;
    skip_blanks();
    const char quote = position_ < text_.size() ? text_[position_] : '\0';
    if (quote != '"' && quote != '\'') {
      error(fmt::format("the value of the attribute '{}' must stand in quotes", name), position_,
            std::min(position_ + 1, text_.size()));
      return false;
    }
    const std::size_t value_begin = position_ + 1;
    const std::size_t value_end = text_.find(quote, value_begin);
    if (value_end == std::string_view::npos) {
      fatal(fmt::format("the value of the attribute '{}' is not closed", name), position_, position_ + 1,
            fmt::format("add {} at its end", quote));
      return false;
    }
    position_ = value_end + 1;
    const std::size_t less = text_.find('<', value_begin);
    if (less < value_end) {
      error(fmt::format("'<' in the value of the attribute '{}'", name), less, less + 1,
            fmt::format("write &lt; for the character, or add the quote {} that is missing before it", quote));
      const bool quote_is_missing =
          position_ < text_.size() && !is_blank(text_[position_]) && !at(">") && !at("/>");
      if (quote_is_missing) {
        stopped_ = true;
        open_.clear();
        position_ = text_.size();
        return false;
      }
    }
    XmlAttribute attribute;
    attribute.name = name;
    attribute.name_where = range(begin, name_end);
    attribute.value = attribute_value(value_begin, value_end);
    const bool empty = value_begin == value_end;
    attribute.value_where = empty ? range(value_begin - 1, value_end + 1) : range(value_begin, value_end);
    const auto same = std::find_if(tag.attributes.begin(), tag.attributes.end(),
                                   [&](const XmlAttribute& other) { return other.name == name; });
    if (same != tag.attributes.end()) {
      const SourceFile::Position first = file_->position(same->name_where.begin);
      error(fmt::format("duplicate attribute '{}' of <{}>", name, tag.name), begin, name_end,
            fmt::format("it was given first at line {}, column {}", first.line, first.column));
    }
    tag.attributes.push_back(std::move(attribute));
    return true;
  }

  LocatedText attribute_value(std::size_t begin, std::size_t end) {
    LocatedText value({}, range(begin, begin));
    const auto add = [&](std::string_view decoded, std::size_t from, std::size_t to) {
      value.append(decoded, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
    };
    for (std::size_t i = begin; i < end;) {
      const char c = text_[i];
      if (c == '&') {
        const auto [decoded, size] = reference(i, end);
        add(decoded, i, i + size);
        i += size;
      } else if (c == '\r' && i + 1 < end && text_[i + 1] == '\n') {
        add(" ", i, i + 2);
        i += 2;
      } else if (is_blank(c)) {
        add(" ", i, i + 1);
        ++i;
      } else if (latin1_ && static_cast<unsigned char>(c) >= 0x80) {
        std::string decoded;
        append_utf8(decoded, static_cast<unsigned char>(c));
        add(decoded, i, i + 1);
        ++i;
      } else {
        std::size_t stop = i + 1;
        while (stop < end && text_[stop] != '&' && !is_blank(text_[stop]) &&
               !(latin1_ && static_cast<unsigned char>(text_[stop]) >= 0x80)) {
          ++stop;
        }
        add(text_.substr(i, stop - i), i, stop);
        i = stop;
      }
    }
    return value;
  }

  // What the reference at `begin` ("&" …) stands for, and its size in the file.
  std::pair<std::string, std::size_t> reference(std::size_t begin, std::size_t end) {
    const std::string_view text = text_.substr(begin, end - begin);
    std::size_t size = 1;
    while (size < text.size() && (is_name_character(text[size]) || text[size] == '#')) {
      ++size;
    }
    if (size == 1 || size == text.size() || text[size] != ';') {
      error("'&' starts no entity here", begin, begin + 1, "write &amp; for the character itself");
      return {"&", 1};
    }
    const std::string_view name = text.substr(1, size - 1);
    ++size;
    if (name.starts_with('#')) {
      const bool hexadecimal = name.starts_with("#x");
      const std::string_view digits = name.substr(hexadecimal ? 2 : 1);
      std::uint32_t value = 0;
      const auto [last, failure] =
          std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
      if (failure != std::errc() || last != digits.data() + digits.size() || !is_xml_character(value)) {
        error(fmt::format("'&{};' is not a character", name), begin, begin + size);
        return {"?", size};
      }
      std::string decoded;
      append_utf8(decoded, value);
      return {decoded, size};
    }
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kEntities = {
        {{"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}}};
    const auto* known = std::find_if(kEntities.begin(), kEntities.end(), [&](const auto& e) { return e.first == name; });
    if (known == kEntities.end()) {
      error(fmt::format("unknown entity '&{};'", name), begin, begin + size,
            has_doctype_ ? "entities declared in a DOCTYPE are not supported"
                         : "XML knows &lt; &gt; &amp; &quot; &apos; and &#number; only");
      return {"?", size};
    }
    return {std::string(known->second), size};
  }

  void end_tag() {
    const std::size_t begin = position_;
    position_ += 2;
    const std::string name(take_name());
    const std::size_t name_end = position_;
    skip_blanks();
    if (name.empty() || !at(">")) {
      error(fmt::format("the closing tag </{}> is malformed", name), begin, name_end, "write </NAME>");
      position_ = std::min(text_.find_first_of("<>", position_), text_.size());
    }
    if (at(">")) {
      ++position_;
    }
    const auto match =
        std::find_if(open_.rbegin(), open_.rend(), [&](const Open& element) { return element.name == name; });
    if (match != open_.rend()) {
      for (; open_.back().name != name; open_.pop_back()) {
        never_closed(open_.back(), fmt::format("add </{}> before </{}> on line {}", open_.back().name, name, line(begin)));
      }
      scan_.markup.append(text_.substr(begin, position_ - begin));
      open_.pop_back();
    } else if (!open_.empty() && !did_you_mean(name, {open_.back().name}).empty()) {
      error(fmt::format("closing tag </{}> does not match <{}>", name, open_.back().name), begin + 2, name_end,
            fmt::format("<{}> was opened on line {}", open_.back().name, line(open_.back().begin)));
      open_.pop_back();
    } else {
      const bool already_closed = last_self_closed_ && last_self_closed_->name == name;
      error(fmt::format("closing tag </{}> without an opening tag", name), begin + 2, name_end,
            already_closed
                ? fmt::format("the tag <{}> on line {} is already closed by its '/>'", name, line(last_self_closed_->begin))
                : "");
    }
  }

  void never_closed(const Open& element, std::string help) {
    error(fmt::format("<{}> is never closed", element.name), element.begin, element.begin + 1 + element.name.size(),
          std::move(help));
  }

  void finish() {
    if (stopped_) {
      return;
    }
    for (; !open_.empty(); open_.pop_back()) {
      never_closed(open_.back(), fmt::format("add </{}>", open_.back().name));
    }
    if (!has_root_ && scan_.errors.empty()) {
      error("the file holds no element", text_.size(), text_.size(), "expected <launch> ... </launch>");
    }
  }

  static std::vector<std::string> declared_prefixes(const XmlTag& tag) {
    constexpr std::string_view kDeclaration = "xmlns:";
    std::vector<std::string> prefixes;
    for (const XmlAttribute& attribute : tag.attributes) {
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
    for (const XmlAttribute& attribute : tag.attributes) {
      check(attribute.name, attribute.name_where);
    }
  }

  // True when there was a blank.
  bool skip_blanks() {
    const std::size_t begin = position_;
    while (position_ < text_.size() && is_blank(text_[position_])) {
      ++position_;
    }
    return position_ > begin;
  }

  std::string_view take_name() {
    const std::size_t begin = position_;
    if (position_ < text_.size() && is_name_start(text_[position_])) {
      while (position_ < text_.size() && is_name_character(text_[position_])) {
        ++position_;
      }
    }
    return text_.substr(begin, position_ - begin);
  }

  std::shared_ptr<const SourceFile> file_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::vector<Open> open_;
  std::optional<Open> last_self_closed_;
  bool has_root_ = false;
  bool has_doctype_ = false;
  bool latin1_ = false;
  bool stopped_ = false;  // an error that leaves no sense in what follows
  XmlScan scan_;
};

}  // namespace

XmlScan scan_xml(const std::shared_ptr<const SourceFile>& file) { return XmlScanner(file).scan(); }

}  // namespace launch
