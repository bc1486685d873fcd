// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/simple_yaml.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/simple_yaml_cursor.hpp"

namespace launch {

namespace {

constexpr std::size_t kMaximumDepth = 50;
constexpr std::size_t kDepthOfList = 1;  // whose items read_list() hands over
constexpr std::size_t kKeysOfItem = 2;   // of a mapping in a list: what is reserved
constexpr std::size_t kUsualKeys = 8;    // of any other

class SimpleYaml : private SimpleYamlCursor {
 public:
  explicit SimpleYaml(const LocatedText& source) : SimpleYamlCursor(source.text()), source_(source) {}

  YamlNode read() {
    begin_document();
    YamlNode root;
    if (at_flow()) {
      flow(root, 0);
      end_line();
      next_line();
    } else {
      block(root, column_, 0);
    }
    require_end();
    return root;
  }

  YamlNode read_list(std::string_view name, const std::function<void(YamlNode& item)>& take) {
    begin_document();
    const std::size_t indentation = column_;
    YamlNode root_key;
    key(root_key);
    if (root_key.scalar.text.text() != name) {
      throw GiveUp();
    }
    end_line();
    next_line();
    if (!at_dash() || column_ < indentation) {
      throw GiveUp();
    }
    YamlNode list;
    take_ = &take;
    sequence(list, column_, kDepthOfList);
    require_end();
    return root_key;
  }

 private:
  void begin_document() {
    next_line();
    if (column_ == 0 && text_.substr(position_, 3) == "---") {
      position_ += 3;
      end_line();
      next_line();
    }
    if (position_ == text_.size()) {
      throw GiveUp();  // no node at all
    }
  }

  void require_end() const {
    if (position_ != text_.size()) {
      throw GiveUp();
    }
  }

  // Nodes are read in their place in the tree: moving them there costs more than reading them.
  void begin_collection(YamlNode& node, YamlNode::Kind kind) const {
    node.kind = kind;
    node.where = source_.range(position_, 1);
  }

  // The collection whose entries begin in this column. Ends at the first line that begins further to the left.
  void block(YamlNode& node, std::size_t indentation, std::size_t depth, bool is_item = false) {
    if (depth > kMaximumDepth) {
      throw GiveUp();
    }
    if (at_dash()) {
      sequence(node, indentation, depth);
    } else {
      mapping(node, indentation, depth, is_item);
    }
  }

  void sequence(YamlNode& node, std::size_t indentation, std::size_t depth) {
    begin_collection(node, YamlNode::Kind::kSequence);
    while (position_ < text_.size() && column_ == indentation && at_dash()) {
      const std::size_t dash = position_++;
      skip_blanks();
      const std::size_t item_column = indentation + (position_ - dash);
      if (at_dash() || is_key()) {
        column_ = item_column;
        block(node.items.emplace_back(), item_column, depth + 1, true);
      } else {
        value_of_line(node.items.emplace_back());
      }
      if (take_ != nullptr && depth == kDepthOfList) {
        (*take_)(node.items.back());
        node.items.pop_back();
      }
    }
    require_end_of_block(indentation);
  }

  void mapping(YamlNode& node, std::size_t indentation, std::size_t depth, bool is_item) {
    begin_collection(node, YamlNode::Kind::kMapping);
    node.entries.reserve(is_item ? kKeysOfItem : kUsualKeys);
    while (position_ < text_.size() && column_ == indentation && !at_dash()) {
      YamlEntry& entry = node.entries.emplace_back();
      key(entry.key);
      require_new_key(node);
      skip_blanks();
      if (peek() == '\n' || peek() == '#') {
        nested(entry.value, indentation, depth);
      } else {
        value_of_line(entry.value);
      }
    }
    require_end_of_block(indentation);
  }

  // What follows the line of its key: deeper, or a list in the column of the key.
  void nested(YamlNode& node, std::size_t indentation, std::size_t depth) {
    end_line();
    next_line();
    if (position_ == text_.size() || (column_ <= indentation && !(column_ == indentation && at_dash()))) {
      throw GiveUp();  // an empty value
    }
    block(node, column_, depth + 1);
  }

  void require_end_of_block(std::size_t indentation) const {
    if (position_ < text_.size() && column_ > indentation) {
      throw GiveUp();
    }
  }

  // A value that ends with its line.
  void value_of_line(YamlNode& node) {
    if (at_flow()) {
      flow(node, 0);
    } else if (at_quote()) {
      quoted(node);
    } else {
      plain(node, plain_end());
    }
    end_line();
    next_line();
  }

  void key(YamlNode& node) {
    const std::size_t colon = colon_of_key();
    if (colon == kNoKey) {
      throw GiveUp();
    }
    if (at_quote()) {
      quoted(node);
    } else {
      plain(node, colon);
    }
    if (position_ != colon) {
      throw GiveUp();
    }
    ++position_;
  }

  // The key of the last entry is not that of another.
  static void require_new_key(const YamlNode& mapping) {
    const std::string& key = mapping.entries.back().key.scalar.text.text();
    for (std::size_t i = 0; i + 1 < mapping.entries.size(); ++i) {
      if (mapping.entries[i].key.scalar.text.text() == key) {
        throw GiveUp();
      }
    }
  }

  // A text that stands for itself, from here to `end`.
  void plain(YamlNode& node, std::size_t end) {
    const std::string_view text = text_.substr(position_, end - position_);
    if (!is_plain_scalar(text)) {
      throw GiveUp();
    }
    node.scalar.text = located(position_, end);
    set_yaml11_type(node.scalar);
    if (node.scalar.type == Scalar::Type::kNull) {
      throw GiveUp();
    }
    node.where = node.scalar.text.range();
    node.is_plain = true;
    position_ = end;
  }

  LocatedText located(std::size_t begin, std::size_t end) const {
    const SourceRange range = source_.range(begin, end - begin);
    require_verbatim(range, end - begin);
    return LocatedText(std::string(text_.substr(begin, end - begin)), range);
  }

  static void require_verbatim(const SourceRange& range, std::size_t size) {
    if (range && range.end - range.begin != size) {
      throw GiveUp();  // an entity of XML
    }
  }

  void append(LocatedText& text, std::string_view decoded, std::size_t begin, std::size_t end) const {
    const SourceRange range = source_.range(begin, end - begin);
    require_verbatim(range, end - begin);
    text.append(decoded, range.begin, range.end);
  }

  void quoted(YamlNode& node) {
    const char quote = text_[position_++];
    const std::size_t begin = position_;
    LocatedText text({}, source_.range(position_, 0));
    std::size_t run = begin;
    for (;; ++position_) {
      const char c = peek();
      if (c == '\0' || c == '\n' || c == '\r' || c == '\t') {
        throw GiveUp();
      }
      if (quote == '\'' ? (c == quote && peek(1) == quote) : c == '\\') {
        const char escaped = peek(1);
        if (quote == '"' && escaped != '"' && escaped != '\\') {
          throw GiveUp();
        }
        append(text, text_.substr(run, position_ - run), run, position_);
        append(text, text_.substr(position_ + 1, 1), position_, position_ + 2);
        run = ++position_ + 1;
      } else if (c == quote) {
        break;
      }
    }
    append(text, text_.substr(run, position_ - run), run, position_);
    ++position_;
    node.where = text.range();
    node.scalar.type = Scalar::Type::kString;
    node.scalar.text = std::move(text);
  }

  // [a, b] or {a: b} on one line.
  void flow(YamlNode& node, std::size_t depth) {
    if (depth > kMaximumDepth) {
      throw GiveUp();
    }
    const bool is_list = peek() == '[';
    const char closing = is_list ? ']' : '}';
    begin_collection(node, is_list ? YamlNode::Kind::kSequence : YamlNode::Kind::kMapping);
    ++position_;
    skip_blanks();
    while (peek() != closing) {
      if (is_list) {
        flow_value(node.items.emplace_back(), depth);
        if (peek() == ':') {
          throw GiveUp();
        }
      } else {
        YamlEntry& entry = node.entries.emplace_back();
        flow_value(entry.key, depth);
        if (entry.key.kind != YamlNode::Kind::kScalar || peek() != ':' || peek(1) != ' ') {
          throw GiveUp();
        }
        require_new_key(node);
        ++position_;
        skip_blanks();
        flow_value(entry.value, depth);
      }
      skip_blanks();
      if (peek() == ',' && peek(1) == ' ') {
        ++position_;
        skip_blanks();
        if (peek() == closing) {
          throw GiveUp();
        }
      } else if (peek() != closing) {
        throw GiveUp();
      }
    }
    ++position_;
  }

  void flow_value(YamlNode& node, std::size_t depth) {
    if (at_flow()) {
      flow(node, depth + 1);
      return;
    }
    if (at_quote()) {
      quoted(node);
      return;
    }
    std::size_t end = position_;
    while (end < text_.size() && std::string_view(",[]{}\n").find(text_[end]) == std::string_view::npos &&
           !(text_[end] == ':' && end + 1 < text_.size() && text_[end + 1] == ' ')) {
      ++end;
    }
    while (end > position_ && text_[end - 1] == ' ') {
      --end;
    }
    plain(node, end);
  }

  const LocatedText& source_;
  const std::function<void(YamlNode& item)>* take_ = nullptr;  // items of the list of read_list()
};

}  // namespace

std::optional<YamlNode> read_simple_yaml(const LocatedText& source) {
  try {
    return SimpleYaml(source).read();
  } catch (const SimpleYamlCursor::GiveUp&) {
    return std::nullopt;
  }
}

std::optional<YamlNode> read_simple_yaml_list(const LocatedText& source, std::string_view name,
                                              const std::function<void(YamlNode& item)>& take) {
  try {
    return SimpleYaml(source).read_list(name, take);
  } catch (const SimpleYamlCursor::GiveUp&) {
    return std::nullopt;
  }
}

}  // namespace launch
