// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/convert.hpp"
#include "programs/launch/rewrite/declared_element.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/yaml_text.hpp"

namespace launch {

namespace {

class YamlConverter {
 public:
  YamlConverter(Comments comments, const Registry& registry) : comments_(std::move(comments)), registry_(registry) {}

  Converted convert(const Entity& root) {
    comment(comments_.take_before(root.where.begin), 0, true);
    result_.text += "launch:\n";
    if (!root.attributes.empty()) {
      attributes(root, declared_root(), 2);
      result_.text += root.children.empty() ? "  children: []\n" : "  children:\n";
      actions(root, declared_root(), 2);
    } else if (root.children.empty()) {
      result_.text.pop_back();
      result_.text += " []\n";
    } else {
      actions(root, declared_root(), 0);
    }
    comment(comments_.take_rest(), 0, false);
    return std::move(result_);
  }

 private:
  void comment(const std::vector<std::string>& lines, std::size_t indent, bool is_first) {
    for (const std::string& line : lines) {
      if (line.empty()) {
        result_.text += is_first ? "" : "\n";
      } else {
        result_.text += fmt::format("{:{}}# {}\n", "", indent, line);
      }
      is_first = is_first && line.empty();
    }
  }

  void actions(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    bool is_first = true;
    for (const Entity& child : entity.children) {
      const DeclaredElement of_child = declared_in(declared, child.type_name, registry_);
      if (of_child.is_item || child.is_structured_item) {
        continue;
      }
      comment(comments_.take_before(child.where.begin), indent, is_first);
      is_first = false;
      action(child, of_child, indent);
    }
  }

  void action(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    const std::string head = fmt::format("{:{}}- {}:", "", indent, yaml_string(entity.type_name, false));
    if (entity.children.empty()) {
      const std::string line = fmt::format("{} {}", head, flow(entity, declared));
      constexpr std::size_t kShort = 3;
      if (entity.attributes.size() <= kShort && line.size() <= kFormattedColumns) {
        result_.text += line + "\n";
        return;
      }
    }
    result_.text += head + "\n";
    body(entity, declared, indent + 4);
  }

  void attributes(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    for (const Attribute& attribute : entity.attributes) {
      result_.text += fmt::format("{:{}}{}: {}\n", "", indent, yaml_string(attribute.name, false),
                                  value(attribute, declared, false));
    }
  }

  void body(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    attributes(entity, declared, indent);
    std::vector<std::string_view> tags;
    bool holds_actions = false;
    for (const Entity& child : entity.children) {
      const bool is_item = child.is_structured_item || declared_in(declared, child.type_name, registry_).is_item;
      holds_actions = holds_actions || !is_item;
      if (is_item && std::find(tags.begin(), tags.end(), child.type_name) == tags.end()) {
        tags.push_back(child.type_name);
      }
    }
    for (const std::string_view tag : tags) {
      result_.text += fmt::format("{:{}}{}:\n", "", indent, tag);
      for (const Entity& child : entity.children) {
        if (child.type_name == tag) {
          item(child, declared_in(declared, tag, registry_), indent);
        }
      }
    }
    if (needs_list(entity, declared)) {
      result_.text += fmt::format("{:{}}children: []\n", "", indent);
    } else if (holds_actions) {
      result_.text += fmt::format("{:{}}children:\n", "", indent);
      actions(entity, declared, indent);
    }
  }

  void item(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    comment(comments_.take_before(entity.where.begin), indent, true);
    const std::string line = fmt::format("{:{}}- {}", "", indent, flow(entity, declared));
    if (entity.children.empty() && line.size() <= kFormattedColumns) {
      result_.text += line + "\n";
      return;
    }
    const std::size_t begin = result_.text.size();
    body(entity, declared, indent + 2);
    result_.text[begin + indent] = '-';
  }

  std::string flow(const Entity& entity, const DeclaredElement& declared) {
    std::string text;
    for (const Attribute& attribute : entity.attributes) {
      text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", yaml_string(attribute.name, true),
                          value(attribute, declared, true));
    }
    if (needs_list(entity, declared)) {
      text += text.empty() ? "children: []" : ", children: []";
    }
    return "{" + text + "}";
  }

  // An element that holds actions, but has none, says so in YAML.
  bool needs_list(const Entity& entity, const DeclaredElement& declared) const {
    const ActionType* const type = declared.is_item ? nullptr : registry_.find(entity.type_name);
    return declared.holds_actions && type != nullptr && !type->may_hold_none &&
           std::all_of(entity.children.begin(), entity.children.end(), [&](const Entity& child) {
             return child.is_structured_item || declared_in(declared, child.type_name, registry_).is_item;
           });
  }

  std::string value(const Attribute& attribute, const DeclaredElement& declared, bool in_flow) {
    const AttributeSpec* const spec = declared.attribute(attribute.name);
    const bool is_condition = attribute.name == "if" || attribute.name == "unless";
    const AttributeType type = spec != nullptr ? spec->type
                               : is_condition  ? AttributeType::kBoolean
                                               : AttributeType::kText;
    return yaml_value(attribute.value, type, in_flow);
  }

  Comments comments_;
  const Registry& registry_;
  Converted result_;
};

}  // namespace

Converted convert_to_yaml(const Entity& root, Comments comments, const Registry& registry) {
  return YamlConverter(std::move(comments), registry).convert(root);
}

}  // namespace launch
