// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/action_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "launcher/language/former_names.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

// The name that messages have for the type of a value.
std::string kind_of(const Value& value) {
  return value.scalar() != nullptr ? std::string(type_name(value.scalar()->type)) : "list";
}

std::string expected_kind(AttributeType type) {
  switch (type) {
    case AttributeType::kBoolean:
      return "bool";
    case AttributeType::kFloat:
      return "float";
    case AttributeType::kInteger:
      return "int";
    default:
      return "str";
  }
}

bool accepts(const AttributeSpec& spec, const Scalar& scalar) {
  using Type = Scalar::Type;
  const AttributeType type = spec.type;
  if (scalar.type == Type::kUntyped || scalar.type == Type::kString) {
    return true;
  }
  if (spec.extension && type == AttributeType::kText) {
    return scalar.type == Type::kInt || scalar.type == Type::kFloat;  // `exit_code: 0` needs no quotes
  }
  return (type == AttributeType::kBoolean && scalar.type == Type::kBool) ||
         (type == AttributeType::kFloat && scalar.type == Type::kFloat) ||
         (type == AttributeType::kInteger && scalar.type == Type::kInt);
}

// Whether the list holds the words of a command line from a Python launch file.
bool is_made(const std::vector<Value>& words) {
  return std::all_of(words.begin(), words.end(),
                     [](const Value& word) { return word.scalar() != nullptr && word.scalar()->made != nullptr; });
}

std::string literal_text(const Template& given, const Attribute& attribute) {
  if (!given.is_literal()) {
    throw LaunchError(fmt::format("attribute '{}' can't be a substitution", attribute.name), given.where(),
                      "it must be known before anything is visited: use a text");
  }
  Scope nothing;
  return given.perform(nothing);
}

std::string help_for_type(AttributeType type, const Value& value) {
  const Scalar* const scalar = value.scalar();
  if (scalar == nullptr || scalar->type == Scalar::Type::kNull) {
    return {};
  }
  if (type == AttributeType::kFloat && scalar->type == Scalar::Type::kInt) {
    return fmt::format("write {}.0", scalar->text.text());
  }
  if (type == AttributeType::kBoolean) {
    return "write true or false";
  }
  return fmt::format("put it in quotes: \"{}\"", scalar->text.text());
}

std::vector<Template> words_of_list(const Entity& entity, const Attribute& attribute) {
  std::vector<Template> words;
  for (const Value& item : *attribute.value.list()) {
    const Scalar* const scalar = item.scalar();
    if (scalar == nullptr || scalar->type != Scalar::Type::kString) {
      throw LaunchError(fmt::format("the list '{}' of '{}' is expected to hold texts, got {}", attribute.name,
                                    entity.type_name, kind_of(item)),
                        item.where, scalar != nullptr ? help_for_type(AttributeType::kText, item) : std::string(),
                        Finding::kWrongType);
    }
    words.push_back(parse_template(scalar->text));
  }
  return words;
}

constexpr std::size_t kMostNames = 8;  // in a line of help

// The help for a name that is not among the known ones.
std::string help_for_name(const std::string& name, const std::vector<std::string>& known, const std::string& former,
                          std::string_view what) {
  std::string help = former.empty() ? did_you_mean(name, known) : former;
  if (help.empty() && !known.empty() && known.size() <= kMostNames) {
    help = fmt::format("{} {}", what, fmt::join(known, ", "));
  }
  return help.empty() ? "`launch reference` tells what there is" : help;
}

}  // namespace

const ItemSpec* ActionParser::Items::find(std::string_view tag) const {
  if (recursive != nullptr && recursive->tag == tag) {
    return recursive;
  }
  const auto found =
      std::find_if(declared.begin(), declared.end(), [&](const ItemSpec& spec) { return spec.tag == tag; });
  return found == declared.end() ? nullptr : &*found;
}

std::vector<std::string> ActionParser::Items::tags() const {
  std::vector<std::string> tags;
  for (const ItemSpec& item : declared) {
    tags.push_back(item.tag);
  }
  if (recursive != nullptr) {
    tags.push_back(recursive->tag);
  }
  return tags;
}

template <typename Step>
void ActionParser::collect(Step step) {
  try {
    step();
  } catch (const LaunchError& error) {
    errors_.insert(errors_.end(), error.diagnostics().begin(), error.diagnostics().end());
  }
}

std::vector<ActionPtr> ActionParser::parse(std::vector<Entity> entities) {
  errors_.clear();
  std::vector<ActionPtr> actions;
  actions.reserve(entities.size());
  for (Entity& entity : entities) {
    if (ActionPtr action = parse_action(entity)) {
      actions.push_back(std::move(action));
    }
    entity = Entity();
  }
  if (!errors_.empty()) {
    throw LaunchError(std::move(errors_));
  }
  return actions;
}

ActionPtr ActionParser::parse_action(const Entity& entity) {
  if (entity.made != nullptr) {
    return entity.made;
  }
  const ActionType* const type = registry_.find(entity.type_name);
  if (type == nullptr) {
    bool known = false;
    ActionPtr made = parse_foreign_action(entity, known);
    if (!known) {
      report_unknown_action(entity, {}, "");
    }
    return made;
  }

  const std::size_t errors_before = errors_.size();
  Fields fields(entity.where);
  const Items items{type->items};
  parse_attributes(entity, type->attributes, items, true, fields);
  parse_condition(entity, fields);

  fields.items_.reserve(type->items.empty() ? 0 : entity.children.size());
  if (type->holds_actions && !type->may_hold_none && !entity.has_children_list) {
    errors_.push_back({Severity::kError, fmt::format("expected '{}' to have a list of actions", entity.type_name),
                       entity.where, "add a `children:` list", Finding::kMissingAttribute});
  }
  for (const Entity& child : entity.children) {
    if (const ItemSpec* const item = items.find(child.type_name)) {
      parse_item(child, *item, fields);
    } else if (type->holds_actions && (child.made != nullptr || registry_.find(child.type_name) != nullptr)) {
      if (ActionPtr action = parse_action(child)) {
        fields.actions_.push_back(std::move(action));
      }
    } else if (type->holds_actions) {
      bool known = false;
      if (ActionPtr action = parse_foreign_action(child, known)) {
        fields.actions_.push_back(std::move(action));
      }
      if (!known) {
        report_unknown_action(child, items.tags(), fmt::format("'{}' can hold", entity.type_name));
      }
    } else {
      report_unknown_child(entity, child, items);
    }
  }

  ActionPtr action;
  if (errors_.size() == errors_before) {
    collect([&] { action = type->make(std::move(fields)); });
  }
  return action;
}

ActionPtr ActionParser::parse_foreign_action(const Entity& entity, bool& known) {
  ActionPtr made;
  // A name of ROS 1 is explained, not looked for.
  if (registry_.foreign_actions().make && help_for_former_tag(entity.type_name).empty() &&
      !is_item_somewhere(entity.type_name)) {
    const std::size_t errors_before = errors_.size();
    collect([&] { made = registry_.foreign_actions().make(entity, registry_); });
    known = made != nullptr || errors_.size() != errors_before;
  }
  return made;
}

// `known` are the tags that may stand there, too.
void ActionParser::report_unknown_action(const Entity& entity, std::vector<std::string> known, std::string_view what) {
  const std::string former = help_for_former_tag(entity.type_name);
  for (const auto& [tag, unused] : registry_.types()) {
    known.push_back(tag);
  }
  std::string problem;
  if (former.empty() && registry_.foreign_actions().names) {
    ForeignNames foreign = registry_.foreign_actions().names();
    known.insert(known.end(), foreign.names.begin(), foreign.names.end());
    problem = std::move(foreign.problem);
  }
  errors_.push_back({Severity::kError, fmt::format("unrecognized entity of the type '{}'", entity.type_name),
                     entity.where,
                     problem.empty() || !did_you_mean(entity.type_name, known).empty()
                         ? help_for_name(entity.type_name, known, former, what)
                         : problem,
                     is_item_somewhere(entity.type_name) ? Finding::kWrongPlace : Finding::kUnknownName});
}

void ActionParser::report_unknown_child(const Entity& parent, const Entity& child, const Items& items) {
  const bool misplaced = registry_.find(child.type_name) != nullptr;
  errors_.push_back(
      {Severity::kError, fmt::format("unexpected nested tag '{}' in '{}'", child.type_name, parent.type_name),
       child.where,
       misplaced ? fmt::format("'{}' is an action: put it before or behind '{}'", child.type_name, parent.type_name)
                 : help_for_name(child.type_name, items.tags(), "", fmt::format("'{}' can hold", parent.type_name)),
       misplaced || is_item_somewhere(child.type_name) ? Finding::kWrongPlace : Finding::kUnknownName});
}

bool ActionParser::is_item_somewhere(const std::string& tag) const {
  const auto& types = registry_.types();
  return std::any_of(types.begin(), types.end(), [&](const auto& type) {
    const std::vector<ItemSpec>& items = type.second.items;
    return std::any_of(items.begin(), items.end(), [&](const ItemSpec& item) { return item.tag == tag; });
  });
}

void ActionParser::parse_attributes(const Entity& entity, const std::vector<AttributeSpec>& specs, const Items& items,
                                    bool conditions, Fields& fields) {
  fields.attributes_.reserve(entity.attributes.size());
  for (const Attribute& attribute : entity.attributes) {
    if (conditions && (attribute.name == "if" || attribute.name == "unless")) {
      continue;
    }
    const auto spec = std::find_if(specs.begin(), specs.end(),
                                   [&](const AttributeSpec& candidate) { return candidate.name == attribute.name; });
    if (spec == specs.end()) {
      std::vector<std::string> known;
      for (const AttributeSpec& candidate : specs) {
        known.push_back(candidate.name);
      }
      if (conditions) {
        known.insert(known.end(), {"if", "unless"});
      }
      // A YAML list without items looks like the empty value of an attribute.
      const bool is_item = items.find(attribute.name) != nullptr;
      if (is_item && attribute.value.list() != nullptr && attribute.value.list()->empty()) {
        continue;
      }
      errors_.push_back(
          {Severity::kError,
           is_item ? fmt::format("expected '{}' of '{}' to be a list of mappings", attribute.name, entity.type_name)
                   : fmt::format("unexpected attribute '{}' in '{}'", attribute.name, entity.type_name),
           attribute.name_where,
           is_item ? "leave it out when there is none"
                   : help_for_name(attribute.name, known, help_for_former_attribute(entity.type_name, attribute.name),
                                   fmt::format("'{}' has", entity.type_name)),
           is_item                                                ? Finding::kWrongType
           : attribute.name == "if" || attribute.name == "unless" ? Finding::kWrongPlace
                                                                  : Finding::kUnknownName});
      continue;
    }
    if (!fields.has(spec->name)) {
      collect([&] {
        fields.attributes_.push_back({spec->name, parse_value(entity, attribute, *spec), attribute.value.where});
      });
    }
  }
  for (const AttributeSpec& spec : specs) {
    if (spec.required && entity.find(spec.name) == nullptr) {
      errors_.push_back({Severity::kError,
                         fmt::format("attribute '{}' not found in entity '{}'", spec.name, entity.type_name),
                         entity.where, spec.help.empty() ? std::string() : fmt::format("{}: {}", spec.name, spec.help),
                         Finding::kMissingAttribute});
    }
  }
}

Fields::Parsed ActionParser::parse_value(const Entity& entity, const Attribute& attribute,
                                         const AttributeSpec& spec) const {
  if (spec.type == AttributeType::kParameter) {
    return attribute.value;
  }
  const bool takes_words = spec.type == AttributeType::kWords || spec.type == AttributeType::kCommandLine;
  if (takes_words && attribute.value.list() != nullptr && is_made(*attribute.value.list())) {
    std::vector<Template> words;
    for (const Value& word : *attribute.value.list()) {
      words.push_back(*word.scalar()->made);
    }
    return words;
  }
  if (spec.type == AttributeType::kWords && attribute.value.list() != nullptr) {
    return words_of_list(entity, attribute);
  }
  const Scalar* const scalar = attribute.value.scalar();
  if (scalar == nullptr || !accepts(spec, *scalar)) {
    throw LaunchError(fmt::format("attribute '{}' of '{}' is expected to be of type {}, got {}", attribute.name,
                                  entity.type_name, expected_kind(spec.type), kind_of(attribute.value)),
                      attribute.value.where, help_for_type(spec.type, attribute.value), Finding::kWrongType);
  }
  if (spec.type == AttributeType::kLiteral) {
    return scalar->made != nullptr ? literal_text(*scalar->made, attribute) : unescape(scalar->text.text());
  }
  Template parsed = scalar->made != nullptr ? *scalar->made : parse_template(scalar->text);
  switch (spec.type) {
    case AttributeType::kBoolean:
      return BooleanField(std::move(parsed));
    case AttributeType::kFloat:
      return NumberField(std::move(parsed), false);
    case AttributeType::kInteger:
      return NumberField(std::move(parsed), true);
    case AttributeType::kCommandLine:
    case AttributeType::kWords:
      return split_command_line(parsed);
    default:
      return parsed;
  }
}

void ActionParser::parse_condition(const Entity& entity, Fields& fields) {
  const Attribute* const if_given = entity.find("if");
  const Attribute* const unless_given = entity.find("unless");
  if (if_given != nullptr && unless_given != nullptr) {
    errors_.push_back({Severity::kError, "if and unless conditions can't be used simultaneously",
                       unless_given->name_where, "use one, with $(and …) or $(not …) where both are needed",
                       Finding::kExclusive});
    return;
  }
  const Attribute* const given = if_given != nullptr ? if_given : unless_given;
  if (given == nullptr) {
    return;
  }
  collect([&] {
    const AttributeSpec spec{given->name, AttributeType::kText, false, {}, {}};
    fields.condition_ = Condition(std::get<Template>(parse_value(entity, *given, spec)), given == unless_given);
  });
}

void ActionParser::parse_item(const Entity& entity, const ItemSpec& spec, Fields& parent) {
  Fields fields(entity.where);
  const Items items{spec.items, spec.recursive ? &spec : nullptr};
  parse_attributes(entity, spec.attributes, items, spec.has_condition, fields);
  if (spec.has_condition) {
    parse_condition(entity, fields);
  }
  for (const Entity& child : entity.children) {
    if (const ItemSpec* const item = items.find(child.type_name)) {
      parse_item(child, *item, fields);
    } else {
      report_unknown_child(entity, child, items);
    }
  }
  parent.items_.push_back({spec.tag, std::move(fields)});
}

}  // namespace launch
