// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/yaml_document.hpp"

namespace launch {

namespace {

using Kind = YamlNode::Kind;

// Turns the YAML tree into entities. It goes on after an error, so that it finds all errors.
class YamlEntityBuilder {
 public:
  std::vector<Diagnostic> take_errors() { return std::move(errors_); }

  // Moves the texts out of the document. `children` are the entities of the list whose items were handed over before.
  Entity root(YamlNode& document, std::vector<Entity> children) {
    Entity entity;
    if (document.kind != Kind::kMapping) {
      wrong_root(fmt::format("expected a mapping with the one key 'launch', found {}", describe(document)),
                 document.where, "a launch file begins with 'launch:'");
      return entity;
    }
    if (document.entries.size() > 1) {
      const auto other = std::find_if(document.entries.begin(), document.entries.end(),
                                      [](const YamlEntry& entry) { return entry.key.scalar.text.text() != "launch"; });
      wrong_root(fmt::format("expected only the root key 'launch', found {} keys", document.entries.size()),
                 other->key.where, "indent what belongs to 'launch'");
      return entity;
    }
    if (document.entries.empty()) {
      wrong_root("expected the root key 'launch', found an empty mapping", document.where);
      return entity;
    }
    auto& [key, value] = document.entries.front();
    if (!is_name(key) || key.scalar.text.text() != "launch") {
      wrong_root(fmt::format("expected 'launch' as root tag, found '{}'", key.scalar.text.text()), key.where,
                 "a launch file begins with 'launch:'");
      return entity;
    }
    entity.type_name = "launch";
    entity.where = key.where;
    entity.children = std::move(children);
    if (value.is_null()) {
      error("'launch' holds no list of actions", key.where, "write `launch: []` for a launch file that does nothing");
    } else {
      fill(entity, key, value);
      if (!entity.has_children_list) {
        error("'launch' has no list of actions", key.where, "write the actions as a list, or under the key 'children'");
      }
    }
    return entity;
  }

  // One item of a list of actions.
  void item_of_actions(YamlNode& item, std::vector<Entity>& result) {
    if (item.kind != Kind::kMapping || item.entries.empty()) {
      error(fmt::format("expected an action, found {}",
                        item.kind == Kind::kMapping ? "an empty mapping" : describe(item)),
            item.where, not_an_action_help(item));
      return;
    }
    if (item.entries.size() > 1) {
      several_keys(item);
      return;
    }
    auto& [key, value] = item.entries.front();
    if (check_name(key)) {
      action(key, value, result);
    }
  }

 private:
  void error(std::string message, const SourceRange& where, std::string help = {}) {
    errors_.push_back({Severity::kError, std::move(message), where, std::move(help)});
  }

  // Reports the root alone, because errors below a wrong root mean nothing.
  void wrong_root(std::string message, const SourceRange& where, std::string help = {}) {
    errors_.clear();
    error(std::move(message), where, std::move(help));
  }

  // Tags and attribute names are strings. `on` is a boolean in YAML 1.1.
  static bool is_name(const YamlNode& key) {
    return key.kind == Kind::kScalar && key.scalar.type == Scalar::Type::kString;
  }

  bool check_name(const YamlNode& key) {
    if (is_name(key)) {
      return true;
    }
    const bool scalar = key.kind == Kind::kScalar && !key.is_null();
    error(fmt::format("expected a name as key, found {}", describe(key)), key.where,
          scalar ? fmt::format("quote it to make it a text: \"{}\"", key.scalar.text.text()) : "");
    return false;
  }

  void actions(YamlNode& list, std::vector<Entity>& result) {
    result.reserve(result.size() + list.items.size());
    for (YamlNode& item : list.items) {
      item_of_actions(item, result);
    }
  }

  static std::string not_an_action_help(const YamlNode& item) {
    if (item.kind == Kind::kScalar && item.scalar.type == Scalar::Type::kString) {
      return fmt::format("write `- {}: {{...}}`", item.scalar.text.text());
    }
    return "write `- ACTION: {...}`";
  }

  // Reports an item with several keys. Its attributes are probably not indented below its action.
  void several_keys(const YamlNode& item) {
    const YamlEntry& first = item.entries[0];
    const YamlEntry& second = item.entries[1];
    const std::string& name = first.key.scalar.text.text();
    const std::string& other = second.key.scalar.text.text();
    error(fmt::format("an action has exactly one key, its name; found {} keys", item.entries.size()), second.key.where,
          first.value.is_null() ? fmt::format("indent '{}' deeper than '{}' to make it an attribute of it", other, name)
                                : fmt::format("write `- {}:` to make it an action of its own", other));
  }

  void action(const YamlNode& key, YamlNode& value, std::vector<Entity>& result) {
    Entity entity;
    entity.type_name = key.scalar.text.text();
    entity.where = key.where;
    if (value.is_null()) {
      error(fmt::format("the action '{}' has no attributes, not even an empty mapping", entity.type_name), key.where,
            fmt::format("write `- {}: {{}}`", entity.type_name));
    } else if (value.kind == Kind::kScalar) {
      error(fmt::format("expected the attributes of '{}', found {}", entity.type_name, describe(value)), value.where,
            fmt::format("write `- {}: {{ATTRIBUTE: VALUE}}`", entity.type_name));
    } else {
      fill(entity, key, value);
    }
    result.push_back(std::move(entity));
  }

  // `content` is a mapping of attributes, or the list of sub-actions.
  void fill(Entity& entity, const YamlNode& key, YamlNode& content) {
    if (content.kind == Kind::kSequence) {
      entity.has_children_list = true;
      actions(content, entity.children);
      return;
    }
    if (content.kind == Kind::kScalar) {
      error(fmt::format("expected a list or a mapping for '{}', found {}", key.scalar.text.text(), describe(content)),
            content.where);
      return;
    }
    entity.has_children_list = false;
    entity.attributes.reserve(content.entries.size());
    for (YamlEntry& entry : content.entries) {
      if (check_name(entry.key)) {
        attribute(entity, entry.key, entry.value);
      }
    }
  }

  void attribute(Entity& entity, YamlNode& key, YamlNode& value) {
    const std::string& name = key.scalar.text.text();
    if (name == "children") {
      entity.has_children_list = true;
      if (value.kind != Kind::kSequence) {
        error(
            fmt::format("expected a list of actions under 'children', found {}", describe(value)),
            value.is_null() ? key.where : value.where,
            value.kind == Kind::kMapping ? "put '- ' before each action" : "write `children: []` when there are none");
        return;
      }
      actions(value, entity.children);
      return;
    }
    if (value.kind == Kind::kMapping) {
      error(fmt::format("'{}' of '{}' is expected to be a list of mappings, found a mapping", name, entity.type_name),
            key.where, "put '- ' before its first key");
      return;
    }
    const bool is_items =
        value.kind == Kind::kSequence && std::any_of(value.items.begin(), value.items.end(),
                                                     [](const YamlNode& item) { return item.kind == Kind::kMapping; });
    if (is_items && std::all_of(value.items.begin(), value.items.end(), is_like_action)) {
      error(fmt::format("unexpected key '{}' in '{}'", name, entity.type_name), key.where,
            "did you mean 'children'? Actions stand there");
    } else if (is_items) {
      structured_items(entity, key, value);
    } else {
      entity.attributes.push_back({name, std::move(key.where), to_value(value)});
    }
  }

  // Its one key has a mapping. No attribute of an item has one.
  static bool is_like_action(const YamlNode& item) {
    return item.kind == Kind::kMapping && item.entries.size() == 1 && item.entries.front().value.kind == Kind::kMapping;
  }

  // Makes a child of each mapping of the list. The children have the name of the key.
  void structured_items(Entity& entity, const YamlNode& key, YamlNode& list) {
    entity.children.reserve(entity.children.size() + list.items.size());
    for (YamlNode& item : list.items) {
      if (item.kind != Kind::kMapping) {
        error(fmt::format("expected a mapping in the list '{}', found {}", key.scalar.text.text(), describe(item)),
              item.where);
        continue;
      }
      Entity child;
      child.type_name = key.scalar.text.text();
      child.where = item.entries.empty() || item.where.begin != item.entries.front().key.where.begin
                        ? item.where
                        : item.entries.front().key.where;
      child.is_structured_item = true;
      fill(child, key, item);
      entity.children.push_back(std::move(child));
    }
  }

  Value to_value(YamlNode& node) {
    if (node.kind == Kind::kScalar) {
      return {std::move(node.scalar), std::move(node.where)};
    }
    std::vector<Value> items;
    for (YamlNode& item : node.items) {
      if (item.kind == Kind::kMapping) {
        error("a mapping inside a nested list", item.where);
        continue;
      }
      items.push_back(to_value(item));
    }
    return {std::move(items), node.where};
  }

  std::vector<Diagnostic> errors_;
};

// A copy in which a CR alone, which ends a line in YAML, is an LF, as yaml-cpp and SourceFile know lines; or the file
// itself, if it has none.
std::shared_ptr<const SourceFile> with_line_ends(const std::shared_ptr<const SourceFile>& file) {
  const std::string& given = file->text();
  const auto is_alone = [&](std::size_t at) { return at + 1 == given.size() || given[at + 1] != '\n'; };
  std::string text;
  for (std::size_t at = given.find('\r'); at != std::string::npos; at = given.find('\r', at + 1)) {
    if (is_alone(at)) {
      text = text.empty() ? given : text;
      text[at] = '\n';
    }
  }
  return text.empty() ? file : std::make_shared<const SourceFile>(file->path(), std::move(text), file->included_from());
}

}  // namespace

Entity parse_yaml(const std::shared_ptr<const SourceFile>& given) {
  const std::shared_ptr<const SourceFile> file = with_line_ends(given);
  const auto size = static_cast<std::uint32_t>(file->text().size());
  const LocatedText source(file->text(), {file, 0, size});
  std::vector<Diagnostic> errors;
  YamlEntityBuilder builder;
  std::vector<Entity> actions;
  YamlNode document =
      read_yaml(source, errors, {"launch", [&](YamlNode& item) { builder.item_of_actions(item, actions); }});
  if (document.is_null()) {
    throw LaunchError("the file is empty", source.range(0, 0), "a launch file begins with 'launch:'");
  }
  Entity root = builder.root(document, std::move(actions));
  std::ranges::move(builder.take_errors(), std::back_inserter(errors));
  if (!errors.empty()) {
    std::stable_sort(errors.begin(), errors.end(), [](const Diagnostic& left, const Diagnostic& right) {
      return left.where.begin < right.where.begin;
    });
    throw LaunchError(std::move(errors));
  }
  return root;
}

}  // namespace launch
