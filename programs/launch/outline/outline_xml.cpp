// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>
#include <vector>

#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : text_(text) {}

  Outline read() {
    while (at_ < text_.size()) {
      const std::size_t next = std::min(text_.find('<', at_), text_.size());
      at_ = next;
      if (at_ == text_.size()) {
        break;
      }
      if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip("<!", ">")) {
        continue;
      }
      if (text_.substr(at_).starts_with("</")) {
        close();
      } else {
        open();
      }
    }
    for (const int number : open_) {
      outline_.elements[static_cast<std::size_t>(number)].whole.end = text_.size();
    }
    return std::move(outline_);
  }

 private:
  bool skip(std::string_view begin, std::string_view end) {
    if (!text_.substr(at_).starts_with(begin)) {
      return false;
    }
    const std::size_t found = text_.find(end, at_ + begin.size());
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
    return true;
  }

  std::size_t end_of_name(std::size_t from) const {
    return std::min(text_.find_first_of(" \t\r\n=/><\"'", from), text_.size());
  }

  void open() {
    OutlineElement element;
    element.whole.begin = at_;
    element.parent = open_.empty() ? -1 : open_.back();
    const std::size_t name_end = end_of_name(at_ + 1);
    element.tag = text_.substr(at_ + 1, name_end - at_ - 1);
    element.tag_span = {at_ + 1, name_end};
    element.head.begin = at_ + 1;
    at_ = name_end;
    bool empty = false;
    while (true) {
      at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
      if (at_ == text_.size() || text_[at_] == '<' || text_[at_] == '>') {
        break;
      }
      if (text_.substr(at_).starts_with("/>")) {
        empty = true;
        break;
      }
      if (text_[at_] == '/' || text_[at_] == '=' || text_[at_] == '"' || text_[at_] == '\'') {
        ++at_;  // it stands here by mistake
        continue;
      }
      element.attributes.push_back(attribute());
    }
    element.head.end = at_;
    if (at_ < text_.size() && text_[at_] != '<') {
      at_ += empty ? 2 : 1;
    }
    element.whole.end = at_;
    outline_.elements.push_back(std::move(element));
    if (!empty) {
      open_.push_back(static_cast<int>(outline_.elements.size()) - 1);
    }
  }

  OutlineAttribute attribute() {
    OutlineAttribute attribute;
    attribute.name_span = {at_, end_of_name(at_)};
    attribute.name = text_.substr(at_, attribute.name_span.end - at_);
    at_ = attribute.name_span.end;
    const std::size_t equals = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
    if (equals == text_.size() || text_[equals] != '=') {
      return attribute;
    }
    const std::size_t quote = std::min(text_.find_first_not_of(kBlanks, equals + 1), text_.size());
    if (quote == text_.size() || (text_[quote] != '"' && text_[quote] != '\'')) {
      at_ = equals + 1;
      return attribute;
    }
    // A value that is not closed ends with its line, so that what follows is read as if it were.
    std::size_t end = text_.find(text_[quote], quote + 1);
    const std::size_t line_end = std::min(text_.find('\n', quote), text_.size());
    const bool looks_open =
        end == std::string_view::npos ||
        (end > line_end && text_.substr(quote + 1, end - quote - 1).find('<') != std::string_view::npos);
    end = looks_open ? line_end : end;
    attribute.value = Span{quote + 1, end};
    at_ = looks_open ? end : end + 1;
    return attribute;
  }

  void close() {
    const std::size_t name_end = end_of_name(at_ + 2);
    const std::string_view tag = text_.substr(at_ + 2, name_end - at_ - 2);
    const std::size_t end = text_.find('>', name_end);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    // The nearest one of this name; those within it were never closed.
    const auto found = std::find_if(open_.rbegin(), open_.rend(), [&](int number) {
      return outline_.elements[static_cast<std::size_t>(number)].tag == tag;
    });
    if (found == open_.rend()) {
      return;
    }
    while (true) {
      const int number = open_.back();
      open_.pop_back();
      OutlineElement& element = outline_.elements[static_cast<std::size_t>(number)];
      element.whole.end = at_;
      if (element.tag == tag) {
        break;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Outline outline_;
  std::vector<int> open_;
};

}  // namespace

Outline outline_of_xml(std::string_view text) {
  return XmlReader(text).read();
}

}  // namespace launch::lsp
