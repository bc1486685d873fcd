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
#include "programs/launch/rewrite/python_forms.hpp"
#include "programs/launch/rewrite/substitution_text.hpp"

namespace launch {

namespace {

std::string python_string(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    switch (c) {
      case '\n':
        result += "\\n";
        break;
      case '\t':
        result += "\\t";
        break;
      case '\r':
        result += "\\r";
        break;
      case '\'':
      case '\\':
        result += '\\';
        [[fallthrough]];
      default:
        result += c;
    }
  }
  return result + "'";
}

const std::string& text_of(const Value& value) {
  return value.scalar()->text.text();
}

// An object as a call: one line if that is short, or a line for each argument.
struct PythonCall {
  std::string head;  // "Node("
  std::vector<std::string> arguments;
  std::string tail = ")";

  std::string text(std::size_t indent) const {
    const std::string line = fmt::format("{}{}{}", head, fmt::join(arguments, ", "), tail);
    if (line.find('\n') == std::string::npos && indent + line.size() < kFormattedColumns) {
      return line;
    }
    std::string result = head + "\n";
    for (const std::string& argument : arguments) {
      result += fmt::format("{:{}}{},\n", "", indent + 4, argument);
    }
    return result + fmt::format("{:{}}{}", "", indent, tail);
  }
};

class PythonConverter {
 public:
  PythonConverter(Comments comments, const Registry& registry) : comments_(std::move(comments)), registry_(registry) {}

  Converted convert(const Entity& root) {
    const std::vector<std::string> head = comments_.take_before(root.where.begin);
    imports_["launch"].insert("LaunchDescription");
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
    for (const auto& [module, names] : imports_) {
      PythonCall import{fmt::format("from {} import (", module), {names.begin(), names.end()}, ")"};
      const std::string line = fmt::format("from {} import {}", module, fmt::join(names, ", "));
      result_.text += (line.size() < kFormattedColumns ? line : import.text(0)) + "\n";
    }
    result_.text += "\n\ndef generate_launch_description():\n    return LaunchDescription([\n" + body + "    ])\n";
    return std::move(result_);
  }

 private:
  void refuse(const std::string& what, const SourceRange& where) {
    result_.errors.push_back(
        {Severity::kError, fmt::format("launch convert knows no form in Python for {}", what), where,
         "write it by hand (docs/python_launch_files.md), or leave this file as it is and include it"});
  }

  std::string name(std::string_view module, std::string_view name) {
    imports_[std::string(module)].insert(std::string(name));
    return std::string(name);
  }

  // One expression, or a list of them.
  std::string text(const std::vector<SubstitutionText>& pieces, const SourceRange& where) {
    std::vector<std::string> parts;
    for (const SubstitutionText& piece : pieces) {
      parts.push_back(piece.call.empty() ? python_string(piece.words) : call(piece.call.front(), where));
    }
    return parts.empty() ? "''" : parts.size() == 1 ? parts.front() : fmt::format("[{}]", fmt::join(parts, ", "));
  }

  std::string text(const std::string& given, const SourceRange& where) {
    return text(substitution_texts(given), where);
  }

  std::string call(const SubstitutionCall& call, const SourceRange& where) {
    const auto found = python_substitutions().find(call.name);
    if (found == python_substitutions().end() || call.arguments.size() > found->second.arguments.size()) {
      refuse(fmt::format("this use of $({})", call.name), where);
      return "None";
    }
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
      const std::string_view argument = found->second.arguments[i];
      arguments.push_back((argument.empty() ? "" : std::string(argument) + "=") + text(call.arguments[i], where));
    }
    return fmt::format("{}({})", name(found->second.module, found->second.name), fmt::join(arguments, ", "));
  }

  // What the rules of YAML make of the text of a parameter.
  std::string typed(const Value& value) {
    if (const auto* const list = value.list()) {
      std::vector<std::string> items;
      std::transform(list->begin(), list->end(), std::back_inserter(items),
                     [this](const Value& item) { return typed(item); });
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
    const Scalar& scalar = *value.scalar();
    switch (scalar.type) {
      case Scalar::Type::kBool:
        return scalar.bool_value ? "True" : "False";
      case Scalar::Type::kInt:
        return std::to_string(scalar.int_value);
      case Scalar::Type::kFloat: {
        const std::string number = fmt::format("{}", scalar.float_value);
        return number.find_first_of("n") != std::string::npos ? fmt::format("float('{}')", number) : number;
      }
      case Scalar::Type::kUntyped:
        return typed_text(scalar.text.text(), value.where);
      default:
        return text(scalar.text.text(), value.where);
    }
  }

  std::string typed_text(const std::string& given, const SourceRange& where) {
    if (given.find("$(") != std::string::npos) {
      return text(given, where);
    }
    try {
      const Value read = yaml11_value(LocatedText(given));
      return read.scalar() != nullptr && read.scalar()->type == Scalar::Type::kUntyped ? text(given, where)
                                                                                       : typed(read);
    } catch (const LaunchError&) {
      return text(given, where);
    }
  }

  std::string argument(const PythonArgument& argument, const Value& value) {
    if (argument.kind == PythonKind::kTyped) {
      return typed(value);
    }
    if (argument.kind == PythonKind::kWords) {
      return words(value);
    }
    if (value.scalar() == nullptr) {
      refuse("a list here", value.where);
      return "None";
    }
    const std::string& given = text_of(value);
    const Scalar read = yaml11_scalar(LocatedText(given));
    switch (argument.kind) {
      case PythonKind::kLiteral:
        return python_string(given);
      case PythonKind::kBool:
        return read.type == Scalar::Type::kBool ? (read.bool_value ? "True" : "False") : text(given, value.where);
      case PythonKind::kNumber:
        return read.type == Scalar::Type::kInt     ? std::to_string(read.int_value)
               : read.type == Scalar::Type::kFloat ? given
                                                   : text(given, value.where);
      default:
        return text(given, value.where);
    }
  }

  std::string words(const Value& value) {
    PythonCall list{"[", {}, "]"};
    if (const auto* const items = value.list()) {
      for (const Value& item : *items) {
        list.arguments.push_back(text(text_of(item), item.where));
      }
    } else {
      for (const std::vector<SubstitutionText>& word : command_words(text_of(value))) {
        list.arguments.push_back(text(word, value.where));
      }
    }
    return list.text(kFormattedColumns / 4);
  }

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
            python_string(item->find("value") == nullptr ? "" : text_of(item->find("value")->value)));
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
  std::map<std::string, std::set<std::string>> imports_;
  Converted result_;
};

}  // namespace

Converted convert_to_python(const Entity& root, Comments comments, const Registry& registry) {
  return PythonConverter(std::move(comments), registry).convert(root);
}

}  // namespace launch
