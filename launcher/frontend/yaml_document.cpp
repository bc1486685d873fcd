// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/input_text.hpp"
#include "launcher/frontend/simple_yaml.hpp"
#include "launcher/frontend/yaml_scalar_place.hpp"
#include "launcher/frontend/yaml_syntax_error.hpp"

namespace launch {

namespace {

// Aliases of aliases can make a short text stand for a huge tree.
constexpr std::size_t kMaximumNodes = 1'000'000;

constexpr std::string_view kStandardTag = "tag:yaml.org,2002:";

// Builds the tree from yaml-cpp's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const LocatedText& source, std::size_t offset, std::vector<Diagnostic>& errors)
      : source_(source), offset_(offset), errors_(errors) {}

  YamlNode take_root() { return std::move(root_); }

  // Where the innermost '[' or '{' that is still open stands.
  std::optional<std::size_t> open_bracket() const {
    return open_.empty() || !open_.back().is_flow ? std::nullopt : std::optional(open_.back().begin);
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const std::size_t at = position(mark);
    YamlNode node;
    const std::string_view text = std::string_view(source_.text()).substr(at);
    for (const std::string_view word : {"~", "null", "Null", "NULL"}) {
      const std::string_view behind = text.substr(std::min(word.size(), text.size()));
      if (text.starts_with(word) &&
          (behind.empty() || std::string_view(" \t\r\n,]}").find(behind.front()) != std::string_view::npos)) {
        node.scalar.text = LocatedText(std::string(word), source_.range(at, word.size()));
      }
    }
    node.where = node.scalar.text.text().empty() ? source_.range(at, 0) : node.scalar.text.range();
    node.scalar.type = Scalar::Type::kNull;
    check_colon(node);
    add(std::move(node), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node;
    scalar_begin_ = position(mark);
    auto [text, end, closed] = locate_yaml_scalar(source_, scalar_begin_, value);
    scalar_end_ = end;
    if (!closed) {
      const SourceRange begin = text.range();
      throw LaunchError("the quoted text is not closed", {begin.file, begin.begin - 1, begin.begin},
                        "add the missing quote");
    }
    node.where = text.range();
    node.is_plain = tag == "?";
    if (node.is_plain) {
      node.scalar = yaml11_scalar(std::move(text));
    } else {
      node.scalar = tagged_scalar(tag, std::move(text));
    }
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw LaunchError("the alias stands inside the node that it refers to", source_.range(position(mark), 1));
    }
    nodes_ += found->second.size;
    if (nodes_ > kMaximumNodes) {
      throw LaunchError(fmt::format("the aliases expand to more than {} nodes", kMaximumNodes),
                        source_.range(position(mark), 1));
    }
    scalar_begin_ = position(mark);
    scalar_end_ = std::min(source_.text().find_first_of(" :", scalar_begin_), source_.text().size());
    add(YamlNode(found->second.node), YAML::NullAnchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    open(YamlNode::Kind::kSequence, mark, anchor, style);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    open(YamlNode::Kind::kMapping, mark, anchor, style);
  }
  void OnMapEnd() override {
    merge(open_.back().node);
    close();
  }

 private:
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor;
    std::size_t nodes_before;
    std::size_t begin;
    bool is_flow;
    std::optional<YamlNode> key;
  };
  struct Anchored {
    YamlNode node;
    std::size_t size;
  };

  std::size_t position(const YAML::Mark& mark) const {
    return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)) + offset_, source_.text().size());
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor, YAML::EmitterStyle::value style) {
    YamlNode node;
    node.kind = kind;
    node.where = source_.range(position(mark), 1);
    open_.push_back({std::move(node), anchor, nodes_, position(mark), style == YAML::EmitterStyle::Flow, std::nullopt});
  }

  // yaml-cpp takes a line without a colon for a key without a value.
  void check_colon(const YamlNode& value) const {
    if (!value.scalar.text.text().empty() || open_.empty() || open_.back().is_flow || !open_.back().key ||
        open_.back().key->kind != YamlNode::Kind::kScalar) {
      return;
    }
    const std::string_view text = source_.text();
    const bool explicit_key = text.substr(0, scalar_begin_).ends_with("? ");
    const std::size_t next = text.find_first_not_of(' ', scalar_end_);
    if (!explicit_key && (next == std::string_view::npos || text[next] != ':')) {
      throw LaunchError("expected 'KEY: VALUE'", open_.back().key->where, "a ':' with a space after it is missing");
    }
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.node), done.anchor, nodes_ - done.nodes_before + 1);
  }

  void add(YamlNode node, YAML::anchor_t anchor, std::size_t size = 1) {
    ++nodes_;
    if (anchor != YAML::NullAnchor) {
      anchors_[anchor] = {node, size};
    }
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::kSequence) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.key) {
      parent.key = std::move(node);
    } else {
      parent.node.entries.push_back({std::move(*parent.key), std::move(node)});
      parent.key.reset();
    }
  }

  Scalar tagged_scalar(const std::string& tag, LocatedText text) {
    Scalar scalar;
    scalar.type = Scalar::Type::kString;
    if (tag != "!" && tag != fmt::format("{}str", kStandardTag)) {
      Scalar typed = yaml11_scalar(text);
      if (tag == fmt::format("{}{}", kStandardTag, type_name(typed.type))) {
        return typed;
      }
      errors_.push_back(
          {Severity::kError, fmt::format("the tag '{}' does not fit this text", tag), text.range(), "remove the tag"});
    }
    scalar.text = std::move(text);
    return scalar;
  }

  // Resolves the merge keys of a mapping and finds keys given twice. Keys of the mapping itself win over merged ones,
  // earlier merged mappings over later ones.
  void merge(YamlNode& mapping) {
    std::vector<YamlEntry> own;
    std::vector<YamlEntry> merged;
    std::map<std::string, SourceRange, std::less<>> seen;
    for (YamlEntry& entry : mapping.entries) {
      const Scalar& key = entry.key.scalar;
      const bool is_scalar = entry.key.kind == YamlNode::Kind::kScalar;
      if (is_scalar && entry.key.is_plain && key.text.text() == "<<") {
        add_merged(entry.value, merged);
        continue;
      }
      if (is_scalar) {
        const auto [first, is_new] = seen.emplace(key.text.text(), entry.key.where);
        if (!is_new) {
          const bool located = static_cast<bool>(first->second);
          errors_.push_back({Severity::kError, fmt::format("duplicate key '{}'", key.text.text()), entry.key.where,
                             located ? fmt::format("it was given first at {}", line_and_column(first->second)) : ""});
          continue;
        }
      }
      own.push_back(std::move(entry));
    }
    for (YamlEntry& entry : merged) {
      if (entry.key.kind == YamlNode::Kind::kScalar &&
          seen.emplace(entry.key.scalar.text.text(), entry.key.where).second) {
        own.push_back(std::move(entry));
      }
    }
    mapping.entries = std::move(own);
  }

  void add_merged(const YamlNode& value, std::vector<YamlEntry>& merged) {
    if (value.kind == YamlNode::Kind::kMapping) {
      merged.insert(merged.end(), value.entries.begin(), value.entries.end());
      return;
    }
    const bool mappings = value.kind == YamlNode::Kind::kSequence &&
                          std::all_of(value.items.begin(), value.items.end(),
                                      [](const YamlNode& item) { return item.kind == YamlNode::Kind::kMapping; });
    if (!mappings) {
      errors_.push_back(
          {Severity::kError,
           fmt::format("the merge key '<<' needs a mapping or a list of mappings, found {}", describe(value)),
           value.where,
           {}});
      return;
    }
    for (const YamlNode& item : value.items) {
      merged.insert(merged.end(), item.entries.begin(), item.entries.end());
    }
  }

  static std::string line_and_column(const SourceRange& where) {
    const SourceFile::Position position = where.file->position(where.begin);
    return fmt::format("line {}, column {}", position.line, position.column);
  }

  const LocatedText& source_;
  const std::size_t offset_;  // of yaml-cpp's positions, which don't count a byte order mark
  std::vector<Diagnostic>& errors_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  // The scalar read last: the key, when the value of a key follows.
  std::size_t scalar_begin_ = 0;
  std::size_t scalar_end_ = 0;
};

}  // namespace

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kSequence:
      return "a list";
    case YamlNode::Kind::kMapping:
      return "a mapping";
    case YamlNode::Kind::kScalar:
      break;
  }
  if (node.is_null()) {
    return "nothing";
  }
  return fmt::format("{} '{}'", type_name(node.scalar.type), node.scalar.text.text());
}

YamlNode read_yaml(const LocatedText& source, std::vector<Diagnostic>& errors) {
  if (std::optional<Diagnostic> bad = find_bad_character(source)) {
    throw YamlSyntaxError(std::vector<Diagnostic>{std::move(*bad)});
  }
  if (std::optional<YamlNode> simple = read_simple_yaml(source)) {
    return std::move(*simple);
  }
  return read_any_yaml(source, errors);
}

YamlNode read_any_yaml(const LocatedText& source, std::vector<Diagnostic>& errors) {
  const std::size_t offset = source.text().starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  TreeBuilder builder(source, offset, errors);
  try {
    std::istringstream stream(source.text());
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      YamlNode nothing;
      nothing.scalar.type = Scalar::Type::kNull;
      nothing.where = source.range(0, 0);
      return nothing;
    }
    std::vector<Diagnostic> ignored;
    TreeBuilder second(source, offset, ignored);
    if (parser.HandleNextDocument(second)) {
      throw LaunchError("a second YAML document", second.take_root().where, "a file holds one document: remove '---'");
    }
  } catch (const YAML::ParserException& error) {
    const std::size_t at =
        std::min(static_cast<std::size_t>(std::max(error.mark.pos, 0)) + offset, source.text().size());
    throw YamlSyntaxError(std::vector<Diagnostic>{explain_yaml_error(error.msg, at, source, builder.open_bracket())});
  }
  return builder.take_root();
}

}  // namespace launch
