// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/yaml_events.hpp"
#include "launcher/frontend/yaml_scalar_place.hpp"

namespace launch {

namespace {

// Aliases of aliases can make a short text stand for a huge tree.
constexpr std::size_t kMaximumNodes = 1'000'000;
// The depth up to which yaml-cpp lets brackets nest. Aliases of deep nodes inside deep nodes must not nest deeper.
constexpr std::size_t kMaximumDepth = 500;

constexpr std::size_t kUsualKeys = 4;  // a mapping reserves space for them

constexpr std::string_view kStandardTag = "tag:yaml.org,2002:";

// Builds the tree from the events. Each node is built in its place, because moving a node costs more than building it.
class TreeBuilder {
 public:
  TreeBuilder(const LocatedText& source, const YamlEvents& events, std::vector<Diagnostic>& errors,
              const YamlListReader& list)
      : source_(source), events_(events), errors_(errors), list_reader_(list) {}

  // After a syntax error the events, and so the tree, end there.
  YamlNode build() {
    if (events_.list.empty()) {
      root_.where = source_.range(0, 0);
      root_.scalar.type = Scalar::Type::kNull;
    } else {
      node(root_);
    }
    return std::move(root_);
  }

 private:
  struct Anchored {
    YamlNode node;
    std::size_t size;
    std::size_t height;  // levels below the node
  };

  bool at_end() const { return next_ == events_.list.size() || events_.list[next_].kind == YamlEvent::Kind::kEnd; }
  void skip_end() { next_ += next_ == events_.list.size() ? 0 : 1; }

  // If the node is a value in a mapping without brackets, `key` is its key. If `is_list`, the list reader takes the
  // items of the node.
  void node(YamlNode& node, const YamlNode* key = nullptr, bool is_list = false) {
    const YamlEvent& event = events_.list[next_++];
    const std::size_t nodes_before = nodes_++;
    ++depth_;
    const std::size_t deepest_before = std::exchange(deepest_, depth_);
    switch (event.kind) {
      case YamlEvent::Kind::kNull:
        null(node, event, key);
        break;
      case YamlEvent::Kind::kScalar:
        scalar(node, event);
        break;
      case YamlEvent::Kind::kAlias:
        alias(node, event);
        break;
      case YamlEvent::Kind::kSequence:
        sequence(node, event, is_list);
        break;
      case YamlEvent::Kind::kMapping:
        mapping(node, event);
        break;
      case YamlEvent::Kind::kEnd:
        break;
    }
    const std::size_t height = deepest_ - depth_--;
    deepest_ = std::max(deepest_, deepest_before);
    if (event.anchor != 0 && event.kind != YamlEvent::Kind::kAlias) {
      const std::size_t size = nodes_ - nodes_before;
      count(size, event);  // for the copy in `anchors_`
      anchors_[event.anchor] = {node, size, height};
    }
  }

  // Counts nodes that are copied.
  void count(std::size_t nodes, const YamlEvent& event) {
    nodes_ += nodes;
    if (nodes_ > kMaximumNodes) {
      throw LaunchError(fmt::format("the aliases expand to more than {} nodes", kMaximumNodes),
                        source_.range(event.at, 1));
    }
  }

  void null(YamlNode& node, const YamlEvent& event, const YamlNode* key) {
    const std::string_view text = std::string_view(source_.text()).substr(event.at);
    node.scalar.type = Scalar::Type::kNull;
    for (const std::string_view word : {"~", "null", "Null", "NULL"}) {
      const std::string_view behind = text.substr(std::min(word.size(), text.size()));
      if (text.starts_with(word) &&
          (behind.empty() || std::string_view(" \t\r\n,]}").find(behind.front()) != std::string_view::npos)) {
        node.scalar.text = LocatedText(std::string(word), source_.range(event.at, word.size()));
        node.where = node.scalar.text.range();
        return;
      }
    }
    node.where = source_.range(event.at, 0);
    check_colon(key);
  }

  // yaml-cpp takes a line without a colon for a key without a value. Here it is an error.
  void check_colon(const YamlNode* key) const {
    if (key == nullptr || key->kind != YamlNode::Kind::kScalar) {
      return;
    }
    const std::string_view text = source_.text();
    const bool explicit_key = text.substr(0, scalar_begin_).ends_with("? ");
    const std::size_t next = text.find_first_not_of(' ', scalar_end_);
    if (!explicit_key && (next == std::string_view::npos || text[next] != ':')) {
      throw LaunchError("expected 'KEY: VALUE'", key->where, "a ':' with a space after it is missing");
    }
  }

  void scalar(YamlNode& node, const YamlEvent& event) {
    auto [text, end, closed] = locate_yaml_scalar(source_, event.at, events_.text(event));
    scalar_begin_ = event.at;
    scalar_end_ = end;
    if (!closed) {
      const SourceRange begin = text.range();
      throw LaunchError("the quoted text is not closed", {begin.file, begin.begin - 1, begin.begin},
                        "add the missing quote");
    }
    node.where = text.range();
    node.is_plain = event.is_plain;
    node.scalar.text = std::move(text);
    if (node.is_plain) {
      set_yaml11_type(node.scalar);
    } else {
      apply_tag(events_.tag(event), node.scalar);
    }
  }

  // The tag takes decimal numbers that are no float without it: 10, and 1e3, which YAML 1.1 reads as a text.
  static void make_float(Scalar& scalar) {
    std::string digits = scalar.text.text();
    digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
    const char* const begin = digits.data() + (digits.starts_with('+') ? 1 : 0);
    const char* const end = digits.data() + digits.size();
    double number = 0;
    if (begin != end && std::from_chars(begin, end, number).ptr == end) {
      scalar.type = Scalar::Type::kFloat;
      scalar.float_value = number;
    }
  }

  void apply_tag(std::string_view tag, Scalar& scalar) {
    if (tag != "!" && tag != fmt::format("{}str", kStandardTag)) {
      set_yaml11_type(scalar);
      if (tag == fmt::format("{}{}", kStandardTag, type_name(Scalar::Type::kFloat))) {
        make_float(scalar);
      }
      if (tag == fmt::format("{}{}", kStandardTag, type_name(scalar.type))) {
        return;
      }
      errors_.push_back({Severity::kError, fmt::format("the tag '{}' does not fit this text", tag), scalar.text.range(),
                         "remove the tag"});
    }
    scalar.type = Scalar::Type::kString;
  }

  void alias(YamlNode& node, const YamlEvent& event) {
    const auto found = anchors_.find(event.anchor);
    if (found == anchors_.end()) {
      throw LaunchError("the alias stands inside the node that it refers to", source_.range(event.at, 1));
    }
    count(found->second.size, event);
    deepest_ = std::max(deepest_, depth_ + found->second.height);
    if (deepest_ > kMaximumDepth) {
      throw LaunchError(fmt::format("the aliases nest more than {} levels deep", kMaximumDepth),
                        source_.range(event.at, 1));
    }
    scalar_begin_ = event.at;
    scalar_end_ = std::min(source_.text().find_first_of(" :", scalar_begin_), source_.text().size());
    node = found->second.node;
  }

  void sequence(YamlNode& list, const YamlEvent& event, bool is_list) {
    list.kind = YamlNode::Kind::kSequence;
    list.where = source_.range(event.at, 1);
    while (!at_end()) {
      node(list.items.emplace_back());
      if (is_list) {
        list_reader_.take(list.items.back());
        list.items.pop_back();
      }
    }
    skip_end();
  }

  void mapping(YamlNode& mapping, const YamlEvent& event) {
    mapping.kind = YamlNode::Kind::kMapping;
    mapping.where = source_.range(event.at, 1);
    mapping.entries.reserve(kUsualKeys);
    while (!at_end()) {
      YamlEntry& entry = mapping.entries.emplace_back();
      node(entry.key);
      if (!at_end()) {
        const bool is_list = list_reader_.take && &mapping == &root_ && mapping.entries.size() == 1 &&
                             entry.key.scalar.text.text() == list_reader_.key;
        node(entry.value, event.is_flow ? nullptr : &entry.key, is_list);
      }
    }
    skip_end();
    resolve_merge_keys(mapping, errors_);
  }

  const LocatedText& source_;
  const YamlEvents& events_;
  std::vector<Diagnostic>& errors_;
  const YamlListReader& list_reader_;
  std::size_t next_ = 0;  // the next event
  YamlNode root_;
  std::map<std::size_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  std::size_t depth_ = 0;    // of the node that is being built
  std::size_t deepest_ = 0;  // the greatest depth in the innermost node that is being built
  // The place of the last scalar. If the value of a key follows, it is the place of the key.
  std::size_t scalar_begin_ = 0;
  std::size_t scalar_end_ = 0;
};

}  // namespace

YamlNode read_yaml(const LocatedText& source, std::vector<Diagnostic>& errors, const YamlListReader& list) {
  if (std::optional<Diagnostic> bad = find_bad_character(source)) {
    throw YamlSyntaxError(std::vector<Diagnostic>{std::move(*bad)});
  }
  const YamlStream stream = read_yaml_events(source);
  // An error that is found here comes first in the file, before the place where yaml-cpp gave up.
  YamlNode root = TreeBuilder(source, stream.document, errors, list).build();
  if (stream.error) {
    throw YamlSyntaxError(std::vector<Diagnostic>{*stream.error});
  }
  if (!stream.second_document.list.empty()) {
    std::vector<Diagnostic> ignored;
    throw LaunchError("a second YAML document", TreeBuilder(source, stream.second_document, ignored, {}).build().where,
                      "a file holds one document: remove '---'");
  }
  return root;
}

}  // namespace launch
