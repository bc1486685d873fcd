#include "launcher/frontend/simple_yaml.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "launcher/frontend/frontend.hpp"

namespace launch {

namespace {

constexpr std::size_t kMaximumDepth = 50;
constexpr std::size_t kDepthOfList = 1;   // whose items read_list() hands over
constexpr std::size_t kUsualKeys = 2;     // of a mapping: what is reserved
constexpr std::size_t kMaximumKey = 500;  // YAML ends the search for the ':' of a key somewhere behind

// Thrown for what is out of the ordinary; caught in this file.
struct GiveUp {};

class SimpleYaml {
 public:
  explicit SimpleYaml(const LocatedText& source) : source_(source), text_(source.text()) {}

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
    if (!is_key()) {
      throw GiveUp();
    }
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

  char peek(std::size_t ahead = 0) const { return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0'; }
  bool at_flow() const { return peek() == '[' || peek() == '{'; }
  bool at_dash() const { return peek() == '-' && (peek(1) == ' ' || peek(1) == '\n'); }

  void skip_blanks() {
    while (peek() == ' ') {
      ++position_;
    }
  }

  // From anywhere behind a node: blanks and a comment up to the end of the line.
  void end_line() {
    const std::size_t begin = position_;
    skip_blanks();
    if (peek() == '#' && (position_ > begin || begin == 0 || text_[begin - 1] == '\n' || text_[begin - 1] == ' ')) {
      position_ = std::min(text_.find('\n', position_), text_.size());
    }
    if (position_ < text_.size() && text_[position_] != '\n') {
      throw GiveUp();
    }
  }

  // From the end of a line, or the beginning of the text, to the first character of the next line that has content.
  void next_line() {
    while (position_ < text_.size()) {
      position_ += peek() == '\n' ? 1 : 0;
      const std::size_t begin = position_;
      skip_blanks();
      if (position_ < text_.size() && peek() != '#' && peek() != '\n') {
        column_ = position_ - begin;
        return;
      }
      end_line();
    }
    column_ = 0;
  }

  // Nodes are read in their place in the tree: moving them there costs more than reading them.
  void begin_collection(YamlNode& node, YamlNode::Kind kind) const {
    node.kind = kind;
    node.where = source_.range(position_, 1);
  }

  // The collection whose entries begin in this column. Ends at the first line that begins further to the left.
  void block(YamlNode& node, std::size_t indentation, std::size_t depth) {
    if (depth > kMaximumDepth) {
      throw GiveUp();
    }
    if (at_dash()) {
      sequence(node, indentation, depth);
    } else {
      mapping(node, indentation, depth);
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
        block(node.items.emplace_back(), item_column, depth + 1);
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

  void mapping(YamlNode& node, std::size_t indentation, std::size_t depth) {
    begin_collection(node, YamlNode::Kind::kMapping);
    node.entries.reserve(kUsualKeys);
    while (position_ < text_.size() && column_ == indentation && !at_dash()) {
      if (!is_key()) {
        throw GiveUp();
      }
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
    } else if (peek() == '"' || peek() == '\'') {
      quoted(node);
    } else {
      plain(node, plain_end());
    }
    end_line();
    next_line();
  }

  // Where the plain text that begins here ends in a block: before blanks, and before a comment.
  std::size_t plain_end() const {
    const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
    const std::size_t comment = text_.substr(0, line_end).find(" #", position_);
    const std::size_t end = std::min(comment, line_end);
    const std::string_view line = text_.substr(position_, end - position_);
    const std::size_t colon = line.find(": ");
    const std::size_t last = line.find_last_not_of(' ');
    if (colon != std::string_view::npos || last == std::string_view::npos || line[last] == ':') {
      throw GiveUp();
    }
    return position_ + last + 1;
  }

  // Whether "KEY:" begins here. Texts are recognised by how they begin; the rest follows when the key is read.
  bool is_key() const {
    if (at_flow()) {
      return false;
    }
    const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
    const std::string_view line = text_.substr(position_, line_end - position_);
    std::size_t from = 0;
    if (peek() == '"' || peek() == '\'') {
      from = line.find(peek(), 1);
      if (from == std::string_view::npos || from + 1 >= line.size() || line[from + 1] != ':') {
        return false;
      }
    }
    const std::size_t colon = line.find(": ", from);
    const bool at_end = colon == std::string_view::npos && line.ends_with(':');
    const std::size_t end = at_end ? line.size() - 1 : colon;
    return end != std::string_view::npos && end < std::min(line.find(" #"), kMaximumKey);
  }

  void key(YamlNode& node) {
    if (peek() == '"' || peek() == '\'') {
      quoted(node);
    } else {
      std::size_t colon = position_;
      while (!(text_[colon] == ':' &&
               (colon + 1 == text_.size() || text_[colon + 1] == ' ' || text_[colon + 1] == '\n'))) {
        ++colon;
      }
      if (colon == position_ || text_[colon - 1] == ' ') {
        throw GiveUp();
      }
      plain(node, colon);
    }
    if (peek() != ':' || (peek(1) != ' ' && peek(1) != '\n')) {
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
    node.scalar = yaml11_scalar(located(position_, end));
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
    if (peek() == '"' || peek() == '\'') {
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
  const std::string_view text_;
  std::size_t position_ = 0;
  std::size_t column_ = 0;  // of the line's first character, where next_line() has stopped
  const std::function<void(YamlNode& item)>* take_ = nullptr;  // items of the list of read_list()
};

}  // namespace

std::optional<YamlNode> read_simple_yaml(const LocatedText& source) {
  try {
    return SimpleYaml(source).read();
  } catch (const GiveUp&) {
    return std::nullopt;
  }
}

std::optional<YamlNode> read_simple_yaml_list(const LocatedText& source, std::string_view name,
                                              const std::function<void(YamlNode& item)>& take) {
  try {
    return SimpleYaml(source).read_list(name, take);
  } catch (const GiveUp&) {
    return std::nullopt;
  }
}

}  // namespace launch
