// SPDX-License-Identifier: Apache-2.0
#include "actions/parameters/parameter_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "launcher/frontend/yaml_scalar_place.hpp"

namespace launch {

namespace {

// Aliases of aliases can make a short text stand for a huge tree.
constexpr std::size_t kMaximumNodes = 1'000'000;
constexpr std::size_t kMaximumMerges = 500;  // inside each other

LaunchError fault(std::string message, const SourceRange& where, std::string help = {}) {
  return {std::move(message), where, std::move(help), Finding::kWrongParameterFile};
}

}  // namespace

ParameterTree::ParameterTree(const LocatedText& source, const YamlEvents& events,
                             std::function<void(const SourceRange&)> on_alias)
    : source_(source), events_(events), on_alias_(std::move(on_alias)) {
  find_ends();
}

bool ParameterTree::is_empty() const {
  return events_.list.empty() || (kind(0) == Kind::kNull && text_of(0).text.empty());
}

void ParameterTree::find_ends() {
  std::vector<std::size_t> open;
  end_.resize(events_.list.size());
  for (std::size_t i = 0; i < events_.list.size(); ++i) {
    end_[i] = i + 1;
    if (kind(i) == Kind::kSequence || kind(i) == Kind::kMapping) {
      open.push_back(i);
    } else if (kind(i) == Kind::kEnd && !open.empty()) {
      end_[open.back()] = i + 1;
      open.pop_back();
    }
    if (kind(i) != Kind::kAlias && events_.list[i].anchor != 0) {
      anchors_[events_.list[i].anchor] = i;
    }
  }
}

SourceRange ParameterTree::place(Node node) const {
  return is_value(node) ? text_of(node).where : source_.range(events_.list[node].at, 1);
}

void ParameterTree::count_node(Node node) {
  if (++nodes_ > kMaximumNodes || merge_depth_ > kMaximumMerges) {
    throw fault(fmt::format("the aliases expand to more than {} nodes, or {} merge keys stand inside each other",
                            kMaximumNodes, kMaximumMerges),
                source_.range(events_.list[node].at, 1));
  }
}

// What an alias stands for.
ParameterTree::Node ParameterTree::resolved(Node node) {
  count_node(node);
  if (kind(node) != Kind::kAlias) {
    return node;
  }
  const SourceRange where = alias_place(node);
  on_alias_(where);
  const auto target = anchors_.find(events_.list[node].anchor);
  if (target == anchors_.end() || (target->second <= node && node < end_[target->second])) {
    throw fault("the alias stands inside the node that it refers to", where);
  }
  return target->second;
}

SourceRange ParameterTree::alias_place(Node node) const {
  const std::size_t at = events_.list[node].at;
  const std::size_t end = std::min(source_.text().find_first_of(" \t\r\n,]}", at), source_.text().size());
  return source_.range(at, end - at);
}

ParameterTree::Text ParameterTree::text_of(Node node, bool is_key) const {
  const YamlEvent& event = events_.list[node];
  const std::string_view raw = source_.text();
  if (event.kind == Kind::kNull) {
    // The words for nothing are texts for a node. A word with a colon is the key behind an empty value.
    for (const std::string_view word : {"~", "null", "Null", "NULL"}) {
      const std::string_view behind = raw.substr(std::min<std::size_t>(event.at + word.size(), raw.size()));
      const std::size_t next = std::min(behind.find_first_not_of(" \t"), behind.size());
      const bool ends =
          behind.empty() || std::string_view(is_key ? " \t:" : " \t\r\n,]}").find(behind[0]) != std::string_view::npos;
      if (raw.substr(event.at).starts_with(word) && ends && (is_key || !behind.substr(next).starts_with(':'))) {
        return {std::string(word), source_.range(event.at, word.size())};
      }
    }
    return {"", source_.range(event.at, 0)};
  }
  const auto [text, end, closed] = locate_yaml_scalar(source_, event.at, events_.text(event));
  if (!closed) {
    const SourceRange begin = text.range();
    throw fault("the quoted text is not closed", {begin.file, begin.begin - 1, begin.begin}, "add the missing quote");
  }
  // yaml-cpp gives the text of a block the same tag as a quoted one.
  std::size_t at = event.at;
  while (at < raw.size() && (raw[at] == '!' || raw[at] == '&')) {
    at = std::min(raw.find_first_of(" \t\r\n", at), raw.size());
    at = std::min(raw.find_first_not_of(" \t\r\n", at), raw.size());
  }
  const bool is_quoted = at < raw.size() && (raw[at] == '"' || raw[at] == '\'');
  return {text.text(), text.range(), is_quoted, event.is_plain ? std::string_view() : events_.tag(event)};
}

std::vector<ParameterTree::Entry> ParameterTree::entries_of(Node mapping) {
  std::vector<Entry> own;
  std::vector<Entry> merged;
  std::set<std::string> names;
  for (Node key = mapping + 1; key < events_.list.size() && kind(key) != Kind::kEnd;) {
    const Node value = end_[key];
    if (value >= events_.list.size() || kind(value) == Kind::kEnd) {
      break;
    }
    check_colon(key, value, events_.list[mapping].is_flow);
    if (kind(key) == Kind::kScalar && events_.list[key].is_plain && text_of(key).text == "<<") {
      merge(resolved(value), merged);
    } else {
      if (is_value(key)) {
        names.insert(key_of(key).text);
      }
      own.push_back({key, resolved(value)});
    }
    key = end_[value];
  }
  for (const Entry& entry : merged) {
    if (is_value(entry.key) && names.insert(key_of(entry.key).text).second) {
      own.push_back(entry);
    }
  }
  return own;
}

void ParameterTree::merge(Node value, std::vector<Entry>& merged) {
  ++merge_depth_;
  if (kind(value) == Kind::kMapping) {
    const std::vector<Entry> entries = entries_of(value);
    merged.insert(merged.end(), entries.begin(), entries.end());
  } else if (kind(value) == Kind::kSequence) {
    for (const Node item : items_of(value)) {
      merge(item, merged);
    }
  }
  --merge_depth_;
}

// yaml-cpp takes a line without a colon for a key without a value.
void ParameterTree::check_colon(Node key, Node value, bool is_flow) const {
  if (is_flow || kind(value) != Kind::kNull || kind(key) != Kind::kScalar) {
    return;
  }
  const std::string_view text = source_.text();
  const std::size_t begin = events_.list[key].at;
  const std::size_t end = locate_yaml_scalar(source_, begin, events_.text(events_.list[key])).end;
  const std::size_t next = text.find_first_not_of(' ', end);
  if (!text.substr(0, begin).ends_with("? ") && (next == std::string_view::npos || text[next] != ':')) {
    throw fault("expected 'KEY: VALUE'", place(key), "a ':' with a space after it is missing");
  }
}

std::vector<ParameterTree::Node> ParameterTree::items_of(Node list) {
  std::vector<Node> items;
  for (Node item = list + 1; item < events_.list.size() && kind(item) != Kind::kEnd; item = end_[item]) {
    items.push_back(resolved(item));
  }
  return items;
}

}  // namespace launch
