// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/yaml_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace launch {

namespace {

using Kind = YamlNode::Kind;

std::string_view text_of(const YamlNode& key) {
  return key.scalar.text.text();
}

bool is_merge_key(const YamlNode& key) {
  return key.kind == Kind::kScalar && key.is_plain && text_of(key) == "<<";
}

// True if the mapping has no merge key and no key twice. False means only that a closer look is needed.
bool is_resolved(const YamlNode& mapping) {
  constexpr std::size_t kFew = 16;
  const std::vector<YamlEntry>& entries = mapping.entries;
  std::set<std::string_view> seen;
  for (auto entry = entries.begin(); entry != entries.end(); ++entry) {
    const auto has_same_key = [&](const YamlEntry& other) { return text_of(other.key) == text_of(entry->key); };
    const bool is_new = entries.size() <= kFew ? std::none_of(entries.begin(), entry, has_same_key)
                                               : seen.insert(text_of(entry->key)).second;
    if (!is_new || is_merge_key(entry->key)) {
      return false;
    }
  }
  return true;
}

std::string line_and_column(const SourceRange& where) {
  const SourceFile::Position position = where.file->position(where.begin);
  return fmt::format("line {}, column {}", position.line, position.column);
}

void add_merged(const YamlNode& value, std::vector<YamlEntry>& merged, std::vector<Diagnostic>& errors) {
  if (value.kind == Kind::kMapping) {
    merged.insert(merged.end(), value.entries.begin(), value.entries.end());
    return;
  }
  const bool mappings =
      value.kind == Kind::kSequence && std::all_of(value.items.begin(), value.items.end(),
                                                   [](const YamlNode& item) { return item.kind == Kind::kMapping; });
  if (!mappings) {
    errors.push_back(
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

void resolve_merge_keys(YamlNode& mapping, std::vector<Diagnostic>& errors) {
  if (is_resolved(mapping)) {
    return;
  }
  std::vector<YamlEntry> own;
  std::vector<YamlEntry> merged;
  std::map<std::string, SourceRange, std::less<>> seen;
  for (YamlEntry& entry : mapping.entries) {
    if (is_merge_key(entry.key)) {
      add_merged(entry.value, merged, errors);
      continue;
    }
    if (entry.key.kind == Kind::kScalar) {
      const auto [first, is_new] = seen.emplace(text_of(entry.key), entry.key.where);
      if (!is_new) {
        const bool located = static_cast<bool>(first->second);
        errors.push_back({Severity::kError, fmt::format("duplicate key '{}'", text_of(entry.key)), entry.key.where,
                          located ? fmt::format("it was given first at {}", line_and_column(first->second)) : ""});
        continue;
      }
    }
    own.push_back(std::move(entry));
  }
  for (YamlEntry& entry : merged) {
    if (entry.key.kind == Kind::kScalar && seen.emplace(text_of(entry.key), entry.key.where).second) {
      own.push_back(std::move(entry));
    }
  }
  mapping.entries = std::move(own);
}

}  // namespace launch
