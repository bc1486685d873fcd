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
#include "launcher/frontend/yaml_scalar_place.hpp"

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
      if (text.starts_with(word) && (behind.empty() || std::string_view(" \t\r\n,]}").find(behind.front()) != std::string_view::npos)) {
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
    open_.push_back(
        {std::move(node), anchor, nodes_, position(mark), style == YAML::EmitterStyle::Flow, std::nullopt});
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
      errors_.push_back({Severity::kError, fmt::format("the tag '{}' does not fit this text", tag), text.range(),
                         "remove the tag"});
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
                          std::all_of(value.items.begin(), value.items.end(), [](const YamlNode& item) {
                            return item.kind == YamlNode::Kind::kMapping;
                          });
    if (!mappings) {
      errors_.push_back({Severity::kError,
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

// A tab in the indentation of the line at `at`, or of the line before: the cause of most errors there.
std::optional<std::size_t> find_indenting_tab(std::string_view text, std::size_t at) {
  for (int lines = 0; lines < 2; ++lines) {
    const std::size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::size_t content = std::min(text.find_first_not_of(" \t", line_begin), text.size());
    const std::size_t tab = text.find('\t', line_begin);
    if (tab < content) {
      return tab;
    }
    if (line_begin == 0) {
      break;
    }
    at = line_begin - 1;
  }
  return std::nullopt;
}

// The line before the one that begins at `line_begin`, when it should be an entry of a mapping and lacks its ':'. The
// parser then takes both lines for one text, and complains about the ':' of the second.
std::optional<SourceRange> find_line_without_colon(const LocatedText& source, std::size_t line_begin) {
  const std::string_view text = source.text();
  // Bytes [first, last) of the next line above `end` that is not blank; list dashes count as indentation.
  struct Line {
    std::size_t begin, first, last;
  };
  const auto line_above = [&](std::size_t end) -> std::optional<Line> {
    const std::size_t last = end == 0 ? std::string_view::npos : text.find_last_not_of(" \r\n", end - 1);
    if (last == std::string_view::npos) {
      return std::nullopt;
    }
    const std::size_t begin = text.rfind('\n', last) + 1;
    return Line{begin, text.find_first_not_of(" -", begin), last + 1};
  };
  const auto has_colon = [&](const Line& line) {
    const std::string_view content = text.substr(line.begin, line.last - line.begin);
    return content.find(": ") != std::string_view::npos || content.ends_with(':');
  };
  const std::optional<Line> line = line_above(line_begin);
  if (!line || has_colon(*line) || line->first >= line->last) {
    return std::nullopt;
  }
  const std::optional<Line> above = line_above(line->begin);
  // Deeper than a line with a value: the second line of that value.
  const bool continues = above && has_colon(*above) && text[above->last - 1] != ':' &&
                         line->first - line->begin > above->first - above->begin;
  return continues ? std::nullopt : std::optional(source.range(line->first, line->last - line->first));
}

// What is wrong at byte `at`, in the words of a launch file. yaml-cpp tells which rule was broken, not why.
Diagnostic explain(const std::string& rule, std::size_t at, const LocatedText& source,
                   const std::optional<std::size_t>& open_bracket) {
  using namespace YAML::ErrorMsg;
  const std::string_view text = source.text();
  const std::size_t line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  const std::string_view before = text.substr(line_begin, at - line_begin);
  const bool starts_line = before.find_first_not_of(" -") == std::string_view::npos;
  const auto diagnostic = [&](std::string message, std::string help = {}) {
    return Diagnostic{Severity::kError, std::move(message), source.range(at, 1), std::move(help)};
  };

  if (open_bracket && (rule == END_OF_MAP_FLOW || rule == END_OF_SEQ_FLOW || rule == FLOW_END)) {
    const char opening = text[*open_bracket];
    const char closing = opening == '{' ? '}' : ']';
    if (line_begin <= *open_bracket) {
      return diagnostic(fmt::format("expected ',' or '{}'", closing));
    }
    return {Severity::kError, fmt::format("the '{}' is not closed", opening), source.range(*open_bracket, 1),
            fmt::format("add '{}' at its end", closing)};
  }
  if (rule == FLOW_END) {
    return diagnostic("a closing bracket without an opening one");
  }
  if (rule == MAP_VALUE) {
    if (const std::optional<SourceRange> line = find_line_without_colon(source, line_begin)) {
      return {Severity::kError, "expected 'KEY: VALUE'", *line, "a ':' with a space after it is missing"};
    }
    if (before.find(": ") != std::string_view::npos) {
      return diagnostic("': ' inside a text without quotes", "quote the text");
    }
    return diagnostic("a mapping can't start here", "align the key with its neighbours");
  }
  if (rule == END_OF_MAP || rule == END_OF_SEQ) {
    if (!starts_line) {
      return diagnostic("unexpected text after a value", "quote the whole value");
    }
    return diagnostic("the indentation of this line fits none of the lines above", "align it with its neighbours");
  }
  if (rule == MAP_KEY || rule == BLOCK_ENTRY) {
    return diagnostic(rule == MAP_KEY ? "a mapping key can't stand here" : "a list item can't start here",
                      "align it with its neighbours");
  }
  if (rule == UNKNOWN_TOKEN) {
    return diagnostic(fmt::format("a text can't start with '{}'", text.substr(at, 1)), "quote the text");
  }
  if (rule == UNKNOWN_ANCHOR) {
    return diagnostic("the alias refers to no anchor that stands before it", "define it with &NAME");
  }
  return diagnostic(fmt::format("invalid YAML: {}", rule));
}

Diagnostic syntax_error(const YAML::ParserException& error, const LocatedText& source, std::size_t offset,
                        const std::optional<std::size_t>& open_bracket) {
  const std::string& text = source.text();
  std::size_t at = std::min(static_cast<std::size_t>(std::max(error.mark.pos, 0)) + offset, text.size());
  if (const std::optional<std::size_t> tab = find_indenting_tab(text, at)) {
    return {Severity::kError, "a tab can't indent YAML", source.range(*tab, 1), "indent with spaces"};
  }
  // An error at the end of the text is shown behind its last character.
  while (at == text.size() && at > 0 && (text[at - 1] == '\n' || text[at - 1] == '\r')) {
    --at;
  }
  return explain(error.msg, at, source, open_bracket);
}

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
    throw YamlSyntaxError(std::vector<Diagnostic>{syntax_error(error, source, offset, builder.open_bracket())});
  }
  return builder.take_root();
}

}  // namespace launch
