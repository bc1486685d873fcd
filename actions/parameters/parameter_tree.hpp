// SPDX-License-Identifier: Apache-2.0
// The YAML of a parameter file as a tree over its events, with the words, quotes and tags that a node tells apart. Keys
// that are given twice stay twice.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/frontend/yaml_events.hpp"

namespace launch {

class ParameterTree {
 public:
  // A node of the tree: the index of its event.
  using Node = std::size_t;
  using Kind = YamlEvent::Kind;

  struct Text {
    std::string text;
    SourceRange where;
    bool is_quoted = false;
    std::string_view tag = {};  // of a scalar
  };
  struct Entry {
    Node key;
    Node value;
  };

  // Tells of each alias. Both texts must outlive the tree.
  ParameterTree(const LocatedText& source, const YamlEvents& events, std::function<void(const SourceRange&)> on_alias);

  // The functions below throw LaunchError for YAML that yaml-cpp takes and libyaml does not, for aliases that stand
  // inside what they mean, and for a tree that is too large.

  // Whether the text has no content.
  bool is_empty() const;
  // The whole of it, unless it is empty.
  Node root() { return resolved(0); }

  Kind kind(Node node) const { return events_.list[node].kind; }
  // A text or nothing.
  bool is_value(Node node) const { return kind(node) == Kind::kScalar || kind(node) == Kind::kNull; }
  // A text without quotes and tag.
  bool is_plain(Node node) const { return events_.list[node].is_plain; }
  std::string_view tag(Node node) const { return events_.tag(events_.list[node]); }
  SourceRange place(Node node) const;

  // Of a value. The words for nothing, such as ~, are texts; an empty value is the empty text without quotes.
  Text text_of(Node node) const { return text_of(node, false); }
  // The same of a key.
  Text key_of(Node node) const { return text_of(node, true); }
  // Of a mapping; aliases are resolved in values. Those of a merge key (<<) come last, and give way to others.
  std::vector<Entry> entries_of(Node mapping);
  // Of a list, with aliases resolved.
  std::vector<Node> items_of(Node list);

 private:
  void find_ends();
  Text text_of(Node node, bool is_key) const;
  void count_node(Node node);
  Node resolved(Node node);
  SourceRange alias_place(Node node) const;
  void merge(Node value, std::vector<Entry>& merged);
  void check_colon(Node key, Node value, bool is_flow) const;

  const LocatedText& source_;
  const YamlEvents& events_;
  std::function<void(const SourceRange&)> on_alias_;
  std::vector<std::size_t> end_;  // of each event: the index behind its node
  std::map<std::size_t, Node> anchors_;
  std::size_t nodes_ = 0;
  std::size_t merge_depth_ = 0;
};

}  // namespace launch
