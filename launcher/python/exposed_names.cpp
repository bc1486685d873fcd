// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/environment/own_environment.hpp"
#include "launcher/frontend/entity.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/python/python_file.hpp"
#include "launcher/python/python_launch_file.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

// Null where Python is not installed: no package can offer anything there.
python::Runtime* runtime() {
  try {
    return &python_runtime();
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

python::Place place_of(const SourceRange& where) {
  if (!where) {
    return {};
  }
  const std::uint32_t line = where.file->position(where.begin).line;
  const auto begin = static_cast<std::size_t>(where.file->line(line).data() - where.file->text().data());
  return {where.file->path(), line, static_cast<std::uint32_t>(where.begin - begin),
          static_cast<std::uint32_t>(where.end - begin)};
}

python::Value value_of(const Value& value) {
  python::Value made;
  made.where = place_of(value.where);
  const Scalar* const scalar = value.scalar();
  if (scalar == nullptr) {
    std::vector<python::Value> items;
    for (const Value& item : *value.list()) {
      items.push_back(value_of(item));
    }
    made.data = std::move(items);
  } else if (scalar->type == Scalar::Type::kBool) {
    made.data = scalar->bool_value;
  } else if (scalar->type == Scalar::Type::kInt) {
    made.data = scalar->int_value;
  } else if (scalar->type == Scalar::Type::kFloat) {
    made.data = scalar->float_value;
  } else {
    python::Text text;
    if (scalar->type != Scalar::Type::kNull) {
      text.parts.emplace_back().text = scalar->text.text();
    }
    made.data = std::move(text);
  }
  return made;
}

python::Element element_of(const Entity& entity, PythonFile& file) {
  python::Element element;
  element.tag = entity.type_name;
  element.where = place_of(entity.where);
  for (const Attribute& attribute : entity.attributes) {
    const Scalar* const scalar = attribute.value.scalar();
    element.attributes.push_back({attribute.name, place_of(attribute.name_where), value_of(attribute.value),
                                  scalar != nullptr && scalar->type == Scalar::Type::kUntyped});
  }
  for (const Entity& child : entity.children) {
    element.children.push_back(element_of(child, file));
  }
  element.is_item = entity.is_structured_item;
  element.number = file.keep(entity);
  return element;
}

// The actions of one element.
class ExposedAction : public Action {
 public:
  ExposedAction(SourceRange where, std::vector<ActionPtr> actions)
      : Action(std::move(where), {}), actions_(std::move(actions)) {}

  Introspection introspect() const override {
    Introspection introspection;
    introspection.children = &actions_;
    return introspection;
  }

 protected:
  void execute(LaunchContext& context) const override { context.visit(actions_); }

 private:
  std::vector<ActionPtr> actions_;
};

ActionPtr make_action(const Entity& entity, const Registry& registry) {
  python::Runtime* const python = runtime();
  if (python == nullptr || entity.where.file == nullptr) {
    return nullptr;
  }
  const auto file = std::make_shared<PythonFile>(entity.where.file, registry);
  Scope scope;
  scope.environment = own_environment();
  try {
    PythonHost host(*file, scope);
    const std::optional<std::vector<python::Entity>> made = python->make_action(element_of(entity, *file), host);
    return made ? std::make_shared<ExposedAction>(entity.where, file->make_actions(*made)) : nullptr;
  } catch (const python::Error& error) {
    file->places().fail(error);
  }
}

SubstitutionPtr make_substitution(const std::string& name, std::vector<Template> arguments, const SourceRange& where) {
  python::Runtime* const python = runtime();
  if (python == nullptr || where.file == nullptr) {
    return nullptr;
  }
  static const Registry no_actions;
  const auto file = std::make_shared<PythonFile>(where.file, no_actions);
  std::vector<python::Argument> given;
  for (const Template& argument : arguments) {
    python::Argument pieces;
    for (const SubstitutionPtr& part : argument.parts()) {
      const auto* const text = dynamic_cast<const Text*>(part.get());
      if (text != nullptr) {
        pieces.emplace_back(text->text());
      } else {
        pieces.emplace_back(file->keep(part));
      }
    }
    given.push_back(std::move(pieces));
  }
  Scope scope;
  scope.environment = own_environment();
  try {
    PythonHost host(*file, scope);
    const std::optional<python::Text> made = python->make_substitution(name, given, place_of(where), host);
    if (!made) {
      return nullptr;
    }
    const std::vector<SubstitutionPtr> parts = file->make_template(*made, where).parts();
    return parts.size() == 1 ? parts.front() : nullptr;
  } catch (const python::Error& error) {
    file->places().fail(error);
  }
}

ForeignNames names(bool of_actions) {
  python::Runtime* const python = runtime();
  if (python == nullptr) {
    return {};
  }
  static const Registry no_actions;
  const auto file = std::make_shared<PythonFile>(std::make_shared<SourceFile>("", ""), no_actions);
  Scope scope;
  scope.environment = own_environment();
  PythonHost host(*file, scope);
  try {
    python::ExposedNames found = python->exposed_names(of_actions, host);
    return {std::move(found.names), std::move(found.problem)};
  } catch (const python::Error& error) {
    return {{}, error.what()};
  }
}

}  // namespace

ForeignActions exposed_actions() {
  return {make_action, [] { return names(true); }};
}

ForeignSubstitutions exposed_substitutions() {
  return {make_substitution, [] { return names(false); }};
}

}  // namespace launch
