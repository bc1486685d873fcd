// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "launcher/frontend/frontend.hpp"
#include "programs/launch/rewrite/convert.hpp"
#include "programs/launch/rewrite/declared_element.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/python_expressions.hpp"
#include "programs/launch/rewrite/python_forms.hpp"
#include "programs/launch/rewrite/substitution_text.hpp"

namespace launch {

namespace {

class PythonConverter : PythonExpressions {
 public:
  PythonConverter(Comments comments, const Registry& registry) : comments_(std::move(comments)), registry_(registry) {}

  Converted convert(const Entity& root) {
    const std::vector<std::string> head = comments_.take_before(root.where.begin);
    name("launch", "LaunchDescription");
    for (const Attribute& attribute : root.attributes) {
      if (attribute.name != "version") {
        refuse(fmt::format("'{}' of 'launch'", attribute.name), attribute.name_where);
      }
    }
    std::string body = actions(root.children, declared_root(), 8);
    for (const std::string& line : comments_.take_rest()) {
      body += line.empty() ? "" : fmt::format("        # {}\n", line);
    }
    for (const std::string& line : head) {
      result_.text += line.empty() ? "" : fmt::format("# {}\n", line);
    }
    for (const auto& [module, names] : imports()) {
      PythonCall import{fmt::format("from {} import (", module), {names.begin(), names.end()}, ")"};
      const std::string line = fmt::format("from {} import {}", module, fmt::join(names, ", "));
      result_.text += (line.size() < kFormattedColumns ? line : import.text(0)) + "\n";
    }
    result_.text += "\n\ndef generate_launch_description():\n    return LaunchDescription([\n" + body + "    ])\n";
    result_.errors = errors();
    return std::move(result_);
  }

 private:
  std::string actions(const std::vector<Entity>& entities, const DeclaredElement& around, std::size_t indent) {
    std::string result;
    bool is_first = true;
    for (const Entity& entity : entities) {
      const DeclaredElement declared = declared_in(around, entity.type_name, registry_);
      if (declared.is_item || entity.is_structured_item) {
        continue;
      }
      for (const std::string& line : comments_.take_before(entity.where.begin)) {
        result += !line.empty() ? fmt::format("{:{}}# {}\n", "", indent, line) : is_first ? "" : "\n";
        is_first = false;
      }
      is_first = false;
      result += fmt::format("{:{}}{},\n", "", indent, action(entity, declared, indent));
    }
    return result;
  }

  std::string action(const Entity& entity, const DeclaredElement& declared, std::size_t indent) {
    const auto form = python_forms().find(entity.type_name);
    if (form == python_forms().end()) {
      refuse(fmt::format("'{}'", entity.type_name), entity.where);
      return "None";
    }
    PythonCall call{name(form->second.module, form->second.name) + "(", {}, ")"};
    if (entity.type_name == "include") {
      include(entity, call);
    }
    for (const Attribute& attribute : entity.attributes) {
      this->attribute(attribute, entity, declared, form->second, call);
    }
    if (entity.type_name == "group" || entity.type_name == "timer") {
      return with_actions(entity, declared, indent, call);
    }
    children(entity, declared, indent, call);
    return call.text(indent);
  }

  static PythonKind kind_of(AttributeType type) {
    switch (type) {
      case AttributeType::kBoolean:
        return PythonKind::kBool;
      case AttributeType::kFloat:
      case AttributeType::kInteger:
        return PythonKind::kNumber;
      case AttributeType::kWords:
        return PythonKind::kWords;
      default:
        return PythonKind::kText;
    }
  }

  // The list stands where people write it: first in a group, last in a timer.
  std::string with_actions(const Entity& entity, const DeclaredElement& declared, std::size_t indent,
                           const PythonCall& call) {
    for (const Entity& child : entity.children) {
      if (child.is_structured_item || declared_in(declared, child.type_name, registry_).is_item) {
        refuse(fmt::format("'{}' of '{}'", child.type_name, entity.type_name), child.where);
      }
    }
    const bool is_first = entity.type_name == "group";
    const std::string others = fmt::format("{}", fmt::join(call.arguments, ", "));
    const std::string list = actions(entity.children, declared, indent + 4);
    const std::string brackets = fmt::format("[\n{}{:{}}]", list, "", indent);
    if (is_first) {
      return call.head + brackets + (others.empty() ? "" : ", " + others) + ")";
    }
    return call.head + (others.empty() ? "" : others + ", ") + "actions=" + brackets + ")";
  }

  void attribute(const Attribute& attribute, const Entity& entity, const DeclaredElement& declared,
                 const PythonForm& form, PythonCall& call) {
    if (attribute.name == "if" || attribute.name == "unless") {
      const std::string condition =
          name("launch.conditions", attribute.name == "if" ? "IfCondition" : "UnlessCondition");
      call.arguments.push_back(
          fmt::format("condition={}({})", condition, text(text_of(attribute.value), attribute.value.where)));
      return;
    }
    if (entity.type_name == "include" && attribute.name == "file") {
      return;
    }
    if (attribute.name == "on_exit" && attribute.value.scalar() != nullptr && text_of(attribute.value) == "shutdown") {
      call.arguments.push_back(fmt::format("on_exit={}()", name("launch.actions", "Shutdown")));
      return;
    }
    const auto argument = std::find_if(form.arguments.begin(), form.arguments.end(),
                                       [&](const PythonArgument& each) { return each.attribute == attribute.name; });
    const AttributeSpec* const spec = declared.attribute(attribute.name);
    if (argument == form.arguments.end() && spec != nullptr && spec->extension && !declared.holds_actions) {
      // The extensions have their names in Python, too. A list is one of words there, not of the parts of a text.
      std::string named = attribute.name;
      std::replace(named.begin(), named.end(), '-', '_');
      std::string value = this->argument({"", "", kind_of(spec->type)}, attribute.value);
      if (value.starts_with('[') && kind_of(spec->type) == PythonKind::kText) {
        value = fmt::format("{}({})", name("launch.substitutions", "StringJoinSubstitution"), value);
      }
      call.arguments.push_back(fmt::format("{}={}", named, value));
      return;
    }
    if (argument == form.arguments.end()) {
      refuse(fmt::format("'{}' of '{}'", attribute.name, entity.type_name), attribute.name_where);
      return;
    }
    call.arguments.push_back(fmt::format("{}={}", argument->name, this->argument(*argument, attribute.value)));
  }

  void include(const Entity& entity, PythonCall& call) {
    const Attribute* const file = entity.find("file");
    call.arguments.push_back(fmt::format("{}({})",
                                         name("launch.launch_description_sources", "AnyLaunchDescriptionSource"),
                                         file == nullptr ? "None" : text(text_of(file->value), file->value.where)));
  }

  void children(const Entity& entity, const DeclaredElement& declared, std::size_t indent, PythonCall& call) {
    std::map<std::string_view, std::vector<const Entity*>> items;
    for (const Entity& child : entity.children) {
      if (child.is_structured_item || declared_in(declared, child.type_name, registry_).is_item) {
        items[child.type_name].push_back(&child);
      }
    }
    for (const auto& [tag, of_tag] : items) {
      this->items(entity, tag, of_tag, declared_in(declared, tag, registry_), indent, call);
    }
    if (entity.type_name == "load_composable_node" && items.empty()) {
      call.arguments.emplace_back("composable_node_descriptions=[]");
    }
  }

  void items(const Entity& entity, std::string_view tag, const std::vector<const Entity*>& given,
             const DeclaredElement& declared, std::size_t indent, PythonCall& call) {
    PythonCall list{"[", {}, "]"};
    if (tag == "param" || tag == "extra_arg") {
      for (const Entity* const item : given) {
        list.arguments.push_back(parameters(*item));
      }
      call.arguments.push_back((tag == "param" ? "parameters=" : "extra_arguments=") + list.text(indent + 4));
    } else if (tag == "remap") {
      for (const Entity* const item : given) {
        list.arguments.push_back(fmt::format("({}, {})", of(*item, "from"), of(*item, "to")));
      }
      call.arguments.push_back("remappings=" + list.text(indent + 4));
    } else if (tag == "env") {
      PythonCall mapping{"{", {}, "}"};
      for (const Entity* const item : given) {
        mapping.arguments.push_back(fmt::format("{}: {}", of(*item, "name"), of(*item, "value")));
      }
      call.arguments.push_back("additional_env=" + mapping.text(indent + 4));
    } else if (entity.type_name == "include" && tag == "arg") {
      for (const Entity* const item : given) {
        list.arguments.push_back(fmt::format("({}, {})", of(*item, "name"), of(*item, "value")));
      }
      call.arguments.push_back("launch_arguments=" + list.text(indent + 4));
    } else if (tag == "choice") {
      for (const Entity* const item : given) {
        list.arguments.push_back(
            python_literal(item->find("value") == nullptr ? "" : text_of(item->find("value")->value)));
      }
      call.arguments.push_back("choices=" + list.text(indent + 4));
    } else if (tag == "composable_node") {
      std::string nodes;
      for (const Entity* const item : given) {
        for (const std::string& line : comments_.take_before(item->where.begin)) {
          nodes += line.empty() ? "" : fmt::format("{:{}}# {}\n", "", indent + 8, line);
        }
        nodes += fmt::format("{:{}}{},\n", "", indent + 8, action(*item, declared, indent + 8));
      }
      call.arguments.push_back(fmt::format("composable_node_descriptions=[\n{}{:{}}]", nodes, "", indent + 4));
    } else {
      refuse(fmt::format("'{}' of '{}'", tag, entity.type_name), given.front()->where);
    }
  }

  std::string of(const Entity& item, std::string_view attribute) {
    for (const Attribute& given : item.attributes) {
      if (given.name != "name" && given.name != "value" && given.name != "from" && given.name != "to") {
        refuse(fmt::format("'{}' of '{}'", given.name, item.type_name), given.name_where);
      }
    }
    const Attribute* const found = item.find(attribute);
    return found == nullptr || found->value.scalar() == nullptr ? "''"
                                                                : text(text_of(found->value), found->value.where);
  }

  std::string parameters(const Entity& item) {
    if (const Attribute* const from = item.find("from")) {
      std::string more;
      for (const Attribute& attribute : item.attributes) {
        if (attribute.name == "allow_substs") {
          more = fmt::format(", allow_substs={}", argument({"", "", PythonKind::kBool}, attribute.value));
        } else if (attribute.name != "from") {
          refuse(fmt::format("'{}' of 'param'", attribute.name), attribute.name_where);
        }
      }
      return fmt::format("{}({}{})", name("launch_ros.parameter_descriptions", "ParameterFile"),
                         text(text_of(from->value), from->value.where), more);
    }
    return fmt::format("{{{}}}", parameter(item));
  }

  // NAME: VALUE
  std::string parameter(const Entity& item) {
    const Attribute* const value = item.find("value");
    const Attribute* const type = item.find("type");
    for (const Attribute& attribute : item.attributes) {
      if (attribute.name != "name" && attribute.name != "value" && attribute.name != "type") {
        refuse(fmt::format("'{}' of 'param'", attribute.name), attribute.name_where);
      }
    }
    const Attribute* const named = item.find("name");
    const std::string key = named == nullptr ? "''" : text(text_of(named->value), named->value.where);
    if (key.starts_with('[')) {
      refuse("a name of several parts", named->value.where);
    }
    if (value == nullptr) {
      std::vector<std::string> nested;
      for (const Entity& child : item.children) {
        nested.push_back(parameter(child));
      }
      return fmt::format("{}: {{{}}}", key, fmt::join(nested, ", "));
    }
    if (type == nullptr) {
      return fmt::format("{}: {}", key, typed(value->value));
    }
    static const std::map<std::string_view, std::string_view> kTypes = {
        {"int", "int"}, {"float", "float"}, {"bool", "bool"}, {"str", "str"}};
    const auto found = kTypes.find(text_of(type->value));
    if (found == kTypes.end() || value->value.scalar() == nullptr) {
      refuse("this type of a parameter", type->value.where);
      return key + ": None";
    }
    return fmt::format("{}: {}({}, value_type={})", key, name("launch_ros.parameter_descriptions", "ParameterValue"),
                       text(text_of(value->value), value->value.where), found->second);
  }

  Comments comments_;
  const Registry& registry_;
  Converted result_;
};

}  // namespace

Converted convert_to_python(const Entity& root, Comments comments, const Registry& registry) {
  return PythonConverter(std::move(comments), registry).convert(root);
}

}  // namespace launch
