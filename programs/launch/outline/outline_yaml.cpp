// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>
#include <vector>

#include "programs/launch/outline/outline.hpp"

namespace launch::lsp {

namespace {

// Block style, a line at a time. In launch files a key without a value names an element or a list of them, and a key
// with a value is an attribute of the element that it stands under.
class YamlReader {
 public:
  explicit YamlReader(std::string_view text) : text_(text) { outline_.yaml = true; }

  Outline read() {
    for (std::size_t begin = 0; begin < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      line(begin, end);
      begin = end + 1;
    }
    close_down_to(-1, text_.size());
    return std::move(outline_);
  }

 private:
  // A key without a value that holds the lines below it, further to the right.
  struct Open {
    int column;    // of the key
    int element;   // the element of the key, or of the key above
    bool is_list;  // the key holds items: `children`, `param`
    std::string key;
  };

  void close_down_to(int column, std::size_t end) {
    while (!open_.empty() && open_.back().column >= column) {
      if (open_.back().element >= 0 && !open_.back().is_list) {
        outline_.elements[static_cast<std::size_t>(open_.back().element)].whole.end = end;
      }
      open_.pop_back();
    }
  }

  void line(std::size_t begin, std::size_t end) {
    std::size_t at = begin;
    while (at < end && text_[at] == ' ') {
      ++at;
    }
    if (at == end || text_[at] == '#' || text_[at] == '\r') {
      return;
    }
    bool item = false;
    while (at < end && text_[at] == '-' && (at + 1 == end || text_[at + 1] == ' ')) {
      close_down_to(static_cast<int>(at - begin) + 1, begin);
      item = true;
      do {
        ++at;
      } while (at < end && text_[at] == ' ');
    }
    const int column = static_cast<int>(at - begin);
    close_down_to(item ? column + 1 : column, begin);
    if (item && !open_.empty() && open_.back().is_list && open_.back().key != "children" &&
        open_.back().key != "launch") {
      begin_item(at, column);
    }
    key(at, end, column);
  }

  // An item of a list such as `param`: an element with the tag of the list.
  void begin_item(std::size_t at, int column) {
    const Open list = open_.back();
    close_down_to(column, at);
    OutlineElement element;
    element.tag = list.key;
    element.tag_span = {at, at};
    element.head = {at, at};
    element.whole = {at == 0 ? 0 : at - 1, text_.size()};
    element.parent = list.element;
    outline_.elements.push_back(std::move(element));
    open_.push_back({column - 1, static_cast<int>(outline_.elements.size()) - 1, false, {}});
  }

  void key(std::size_t at, std::size_t end, int column) {
    std::size_t colon = at;
    while (colon < end &&
           (text_[colon] != ':' || (colon + 1 < end && text_[colon + 1] != ' ' && text_[colon + 1] != '\r'))) {
      ++colon;
    }
    Span name = {at, colon};
    if (name.end > name.begin && text_[name.end - 1] == '\r') {
      --name.end;
    }
    const bool is_key = colon < end;
    std::size_t value = std::min(is_key ? colon + 1 : end, end);
    while (value < end && text_[value] == ' ') {
      ++value;
    }
    std::size_t value_end = end;
    while (value_end > value && (text_[value_end - 1] == '\r' || text_[value_end - 1] == ' ')) {
      --value_end;
    }
    const std::string key_name(text_.substr(name.begin, name.end - name.begin));
    const int parent = open_.empty() ? -1 : open_.back().element;
    const bool holds_actions = open_.empty() || open_.back().key == "launch" || open_.back().key == "children";
    if (!is_key || value < value_end || !holds_actions) {
      if (is_key && value == value_end && !holds_actions) {
        // `param:` of an element: its items follow.
        open_.push_back({column, parent, true, key_name});
        grow(parent, end);
        return;
      }
      if (holds_actions) {
        element(key_name, name, end, parent);  // a tag that is being written, or `- node: {…}`
        if (text_[std::min(value, text_.size() - 1)] == '{') {
          flow(static_cast<int>(outline_.elements.size()) - 1, value + 1, value_end);
        }
        return;
      }
      attribute(parent, key_name, name, is_key ? std::optional<Span>({value, value_end}) : std::nullopt, end);
      return;
    }
    if (open_.empty() && key_name == "launch") {
      element(key_name, name, end, -1);
      open_.push_back({column, static_cast<int>(outline_.elements.size()) - 1, true, "launch"});
      return;
    }
    element(key_name, name, end, parent);
    open_.push_back({column, static_cast<int>(outline_.elements.size()) - 1, false, {}});
  }

  // "name: a, default: 'b, c'}": the attributes of a mapping in one line. What is nested in it is passed over.
  void flow(int of, std::size_t begin, std::size_t end) {
    int depth = 0;
    char quote = 0;
    std::size_t start = begin;
    for (std::size_t at = begin; at <= end; ++at) {
      const char byte = at < end ? text_[at] : '}';
      if (quote != 0) {
        quote = byte == quote ? '\0' : quote;
      } else if (byte == '\'' || byte == '"') {
        quote = byte;
      } else if (byte == '{' || byte == '[' || byte == '(') {
        ++depth;
      } else if (depth > 0 && (byte == '}' || byte == ']' || byte == ')')) {
        --depth;
      } else if (depth == 0 && (byte == ',' || byte == '}')) {
        pair(of, start, at);
        start = at + 1;
      }
    }
  }

  void pair(int of, std::size_t begin, std::size_t end) {
    begin = std::min(text_.find_first_not_of(' ', begin), end);
    const std::size_t colon = std::min(text_.find(':', begin), end);
    if (begin == colon) {
      return;
    }
    std::size_t value = std::min(colon + 1, end);
    while (value < end && text_[value] == ' ') {
      ++value;
    }
    while (end > value && text_[end - 1] == ' ') {
      --end;
    }
    attribute(of, std::string(text_.substr(begin, colon - begin)), {begin, colon},
              colon < end ? std::optional<Span>({value, end}) : std::nullopt, end);
  }

  void element(const std::string& tag, Span name, std::size_t end, int parent) {
    OutlineElement element;
    element.tag = tag;
    element.tag_span = name;
    element.head = {name.begin, end};
    element.whole = {name.begin == 0 ? 0 : name.begin - 1, end};
    element.parent = parent;
    outline_.elements.push_back(std::move(element));
  }

  void attribute(int of, const std::string& name, Span span, std::optional<Span> value, std::size_t end) {
    if (of < 0) {
      return;
    }
    if (value && value->end > value->begin + 1 && (text_[value->begin] == '"' || text_[value->begin] == '\'') &&
        text_[value->end - 1] == text_[value->begin]) {
      value = Span{value->begin + 1, value->end - 1};
    } else if (value && value->end > value->begin && (text_[value->begin] == '"' || text_[value->begin] == '\'')) {
      ++value->begin;  // it is not closed yet
    }
    outline_.elements[static_cast<std::size_t>(of)].attributes.push_back({name, span, value});
    grow(of, end);
  }

  void grow(int of, std::size_t end) {
    if (of >= 0) {
      OutlineElement& element = outline_.elements[static_cast<std::size_t>(of)];
      element.head.end = std::max(element.head.end, end);
      element.whole.end = std::max(element.whole.end, end);
    }
  }

  std::string_view text_;
  Outline outline_;
  std::vector<Open> open_;
};

}  // namespace

Outline outline_of_yaml(std::string_view text) {
  return YamlReader(text).read();
}

}  // namespace launch::lsp
