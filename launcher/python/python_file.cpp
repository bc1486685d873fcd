// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/python_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/read_source_file.hpp"
#include "launcher/language/action_parser.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

SourceRange PythonPlaces::range(const python::Place& place) {
  std::shared_ptr<const SourceFile> file = file_;
  if (place.line != 0 && place.file != file_->path()) {
    const auto [known, added] = modules_.try_emplace(place.file);
    if (added) {
      try {
        known->second = read_source_file(place.file, file_->included_from());
      } catch (const LaunchError&) {
        // The code comes from no file.
      }
    }
    file = known->second;
  }
  if (place.line == 0 || file == nullptr) {
    return {file_, 0, 0};
  }
  const std::string_view line = file->line(place.line);
  if (line.data() == nullptr) {
    return {file, 0, 0};
  }
  const std::size_t start = static_cast<std::size_t>(line.data() - file->text().data());
  std::size_t begin = std::min<std::size_t>(place.begin, line.size());
  std::size_t end = std::min<std::size_t>(place.end, line.size());
  if (end <= begin) {
    begin = std::min(line.find_first_not_of(" \t"), line.size());
    end = line.size();
  }
  return {std::move(file), static_cast<std::uint32_t>(start + begin), static_cast<std::uint32_t>(start + end)};
}

void PythonPlaces::fail(const python::Error& error) {
  if (error.cause != nullptr) {
    try {
      std::rethrow_exception(error.cause);
    } catch (const LaunchError&) {
      throw;
    } catch (const python::Error& inner) {
      fail(inner);
    } catch (const std::exception&) {
      // Only LaunchError has a place: told as Python's error, at the place of the call.
    }
  }
  std::string help = error.help;
  if (const auto limits = guest_limits(); limits && std::string_view(error.what()).starts_with("MemoryError")) {
    help = fmt::format("Python has {} MB here; --python-memory gives it more", limits->memory >> 20U);
  }
  if (!error.traceback.empty()) {
    help += (help.empty() ? "" : "\n") + error.traceback;
  }
  throw LaunchError(error.what(), range(error.where), std::move(help), Finding::kPython);
}

namespace {

// The call of a part whose only argument is a text as XML files write it.
constexpr std::string_view kParsed = "parsed";
// The call of a part that is a kept substitution, and the tag of an entity that is a kept element (launch/frontend/
// _extensions.py).
constexpr std::string_view kKeptSubstitution = "a template";
constexpr std::string_view kKeptElement = "an element";

// Throws OnlyARunCalls if the object calls a function of the launch file and the scope is one of a plan's events.
void call_if_run(python::Object& object, const Scope& scope, const SourceRange& where) {
  if (!scope.only_planned) {
    return;
  }
  if (std::optional<std::string> function = object.function()) {
    throw OnlyARunCalls(std::move(*function), where);
  }
}

// A substitution that only Python can perform.
class PythonSubstitution : public Substitution {
 public:
  PythonSubstitution(python::ObjectPtr object, std::shared_ptr<PythonFile> file, SourceRange where)
      : Substitution(std::move(where)), object_(std::move(object)), file_(std::move(file)) {}

  std::string perform(Scope& scope) const override {
    call_if_run(*object_, scope, where());
    try {
      PythonHost host(*file_, scope);
      return object_->perform(host);
    } catch (const python::Error& error) {
      file_->places().fail(error);
    }
  }

  std::string describe() const override { return object_->describe(); }

 private:
  python::ObjectPtr object_;
  std::shared_ptr<PythonFile> file_;
};

// An action that only Python can execute: Python gives the entities to visit in its place.
class PythonAction : public Action {
 public:
  PythonAction(python::ObjectPtr object, std::shared_ptr<PythonFile> file, SourceRange where, Condition condition)
      : Action(std::move(where), std::move(condition)), object_(std::move(object)), file_(std::move(file)) {}

 protected:
  void execute(LaunchContext& context) const override {
    call_if_run(*object_, context.scope(), where());
    std::vector<python::Entity> entities;
    try {
      PythonHost host(*file_, context);
      entities = object_->execute(host);
    } catch (const python::Error& error) {
      file_->places().fail(error);
    }
    context.visit(file_->make_actions(entities));
  }

 private:
  python::ObjectPtr object_;
  std::shared_ptr<PythonFile> file_;
};

// An action whose processes also have a name that no launch file can write, by which handlers refer to them; or a
// command for the processes of such an action.
class NamedAction : public Action {
 public:
  NamedAction(ActionPtr action, std::string name)
      : Action(action->where(), {}), action_(std::move(action)), name_(std::move(name)) {}

  Introspection introspect() const override { return action_->introspect(); }

 protected:
  void execute(LaunchContext& context) const override {
    const std::size_t before = context.requests().processes.size();
    const std::size_t commands_before = context.requests().commands.size();
    context.visit(*action_);
    std::vector<ProcessCommand>& commands = context.requests().commands;
    std::for_each(commands.begin() + static_cast<std::ptrdiff_t>(commands_before), commands.end(),
                  [](ProcessCommand& command) { command.of_action = true; });
    std::vector<ProcessSpec>& processes = context.requests().processes;
    for (std::size_t i = before; i < processes.size(); ++i) {
      processes[i].other_names.push_back(name_);
      processes[i].python_action = name_;
    }
  }

 private:
  ActionPtr action_;
  std::string name_;
};

// An event handler. As in ROS 2, it is visited in the scope that the launch has when the event happens.
class LiveHandler : public Action {
 public:
  explicit LiveHandler(ActionPtr action) : Action(action->where(), {}), action_(std::move(action)) {}

  Introspection introspect() const override { return action_->introspect(); }

 protected:
  void execute(LaunchContext& context) const override {
    std::vector<EventHandler>& handlers = context.requests().handlers;
    const std::size_t before = handlers.size();
    context.visit(*action_);
    for (std::size_t i = before; i < handlers.size(); ++i) {
      handlers[i].live = true;
    }
  }

 private:
  ActionPtr action_;
};

}  // namespace

std::vector<ActionPtr> PythonFile::make_actions(const std::vector<python::Entity>& entities) {
  std::vector<Entity> made;
  for (const python::Entity& entity : entities) {
    made.push_back(make_entity(entity));
  }
  return ActionParser(registry_).parse(std::move(made));
}

std::size_t PythonFile::keep(Entity entity) {
  elements_.push_back(std::move(entity));
  return elements_.size() - 1;
}

std::size_t PythonFile::keep(SubstitutionPtr substitution) {
  substitutions_.push_back(std::move(substitution));
  return substitutions_.size() - 1;
}

Entity PythonFile::make_entity(const python::Entity& entity) {
  if (entity.tag == kKeptElement) {
    return elements_.at(static_cast<std::size_t>(std::get<std::int64_t>(entity.attributes.at(0).second.data)));
  }
  Entity made;
  made.type_name = entity.tag;
  made.where = places_.range(entity.where);
  for (const auto& [name, value] : entity.attributes) {
    Attribute attribute{name, {}, make_value(value, made.where)};
    attribute.name_where = attribute.value.where;
    made.attributes.push_back(std::move(attribute));
  }
  for (const python::Entity& child : entity.children) {
    made.children.push_back(make_entity(child));
  }
  if (entity.object != nullptr) {
    Condition condition;
    for (const Attribute& attribute : made.attributes) {
      condition = Condition(*attribute.value.scalar()->made, attribute.name == "unless");
    }
    made.made = std::make_shared<PythonAction>(entity.object, shared_from_this(), made.where, std::move(condition));
  }
  if (!entity.process_name.empty()) {
    std::vector<ActionPtr> actions = ActionParser(registry_).parse({made});
    made.made = std::make_shared<NamedAction>(std::move(actions.front()), entity.process_name);
  } else if (entity.tag.starts_with("on_")) {
    std::vector<ActionPtr> actions = ActionParser(registry_).parse({made});
    made.made = std::make_shared<LiveHandler>(std::move(actions.front()));
  }
  return made;
}

Value PythonFile::make_value(const python::Value& value, const SourceRange& fallback) {
  Value made;
  made.where = value.where.line != 0 ? places_.range(value.where) : fallback;
  if (const auto* const list = std::get_if<std::vector<python::Value>>(&value.data)) {
    std::vector<Value> items;
    for (const python::Value& item : *list) {
      items.push_back(make_value(item, made.where));
    }
    made.data = std::move(items);
    return made;
  }
  Scalar scalar;
  std::string text;
  if (const auto* const boolean = std::get_if<bool>(&value.data)) {
    scalar.type = Scalar::Type::kBool;
    scalar.bool_value = *boolean;
    text = *boolean ? "true" : "false";
  } else if (const auto* const whole = std::get_if<std::int64_t>(&value.data)) {
    scalar.type = Scalar::Type::kInt;
    scalar.int_value = *whole;
    text = fmt::format("{}", *whole);
  } else if (const auto* const number = std::get_if<double>(&value.data)) {
    scalar.type = Scalar::Type::kFloat;
    scalar.float_value = *number;
    text = fmt::format("{}", *number);
  } else {
    scalar.type = Scalar::Type::kString;
    scalar.made = std::make_shared<const Template>(make_template(std::get<python::Text>(value.data), made.where));
    text = scalar.made->describe();
  }
  scalar.text = LocatedText(std::move(text), made.where);
  made.data = std::move(scalar);
  return made;
}

Template PythonFile::make_template(const python::Text& text, const SourceRange& fallback) {
  SourceRange where = text.where.line != 0 ? places_.range(text.where) : fallback;
  std::vector<SubstitutionPtr> parts;
  for (const python::Part& part : text.parts) {
    parts.push_back(make_part(part, where));
  }
  return {std::move(parts), std::move(where)};
}

SubstitutionPtr PythonFile::make_part(const python::Part& part, const SourceRange& fallback) {
  SourceRange where = part.where.line != 0 ? places_.range(part.where) : fallback;
  if (part.kind == python::Part::Kind::kText) {
    return std::make_shared<Text>(part.text, std::move(where));
  }
  if (part.kind == python::Part::Kind::kObject) {
    return std::make_shared<PythonSubstitution>(part.object, shared_from_this(), std::move(where));
  }
  if (part.text == kKeptSubstitution) {
    return substitutions_.at(std::stoul(part.arguments.at(0).parts.at(0).text));
  }
  std::vector<Template> arguments;
  std::string name = part.text;
  if (name == kParsed) {
    // A text with $(…) in it is what joins its parts.
    arguments.push_back(parse_template(LocatedText(std::string(), where)));
    arguments.push_back(parse_template(LocatedText(part.arguments.at(0).parts.at(0).text, where)));
    name = "string-join";
  } else {
    for (const python::Text& argument : part.arguments) {
      arguments.push_back(make_template(argument, where));
    }
  }
  for (const SubstitutionType& type : substitution_types()) {
    if (type.name == name) {
      if (std::optional<std::string> wrong = wrong_number_of_arguments(type, arguments.size())) {
        throw LaunchError(std::move(*wrong), std::move(where));
      }
      return type.make(std::move(arguments), std::move(where));
    }
  }
  throw LaunchError(fmt::format("this launcher has no substitution '{}'", part.text), std::move(where), {},
                    Finding::kUnknownName);
}

PythonHost::PythonHost(PythonFile& file, Scope& scope) : file_(file), scope_(scope), call_(file.places().path()) {
  if (std::optional<GuestRefusal> refusal = guest_refusal(file.places().path())) {
    throw LaunchError(std::move(refusal->reason), file.places().range({file.places().path(), refusal->line, 0, 0}),
                      std::move(refusal->help), Finding::kPython);
  }
}

PythonHost::PythonHost(PythonFile& file, LaunchContext& context) : PythonHost(file, context.scope()) {
  context_ = &context;
}

std::string PythonHost::perform(const python::Text& text) {
  return file_.make_template(text, file_.places().range({})).perform(scope_);
}

std::string PythonHost::perform(const python::Text& text, Variables& configurations) {
  std::swap(scope_.configurations, configurations);
  try {
    std::string performed = perform(text);
    std::swap(scope_.configurations, configurations);
    return performed;
  } catch (...) {
    std::swap(scope_.configurations, configurations);
    throw;
  }
}

void PythonHost::message(const std::string& level, const std::string& logger, const std::string& text) {
  static const std::map<std::string, LogLevel> levels = {{"debug", LogLevel::kDebug},
                                                         {"info", LogLevel::kInfo},
                                                         {"warning", LogLevel::kWarning},
                                                         {"error", LogLevel::kError},
                                                         {"critical", LogLevel::kCritical}};
  if (context_ != nullptr) {
    context_->message(levels.at(level), logger, text);
  } else {
    fmt::print(stderr, "[{}]: {}\n", logger, text);
  }
}

LaunchContext& PythonHost::context() {
  if (context_ == nullptr) {
    throw std::runtime_error("this can only be done while the launch file is visited");
  }
  return *context_;
}

void PythonHost::visit(const std::vector<python::Entity>& entities) {
  context().visit(file_.make_actions(entities));
}

void PythonHost::run_coroutine(python::ObjectPtr object) {
  context().requests().coroutines.push_back({std::move(object), file_.shared_from_this(), file_.places().range({})});
}

void PythonHost::push(bool environment) {
  context().kept_scopes(environment).push_back(scope_);
}

void PythonHost::pop(bool environment) {
  std::vector<Scope>& kept = context().kept_scopes(environment);
  if (kept.empty()) {
    throw std::runtime_error("nothing was pushed that could be popped");
  }
  Scope outer = std::move(kept.back());
  kept.pop_back();
  if (environment) {
    scope_.environment = std::move(outer.environment);
  } else {
    scope_.configurations = std::move(outer.configurations);
    scope_.global_parameters = std::move(outer.global_parameters);
    scope_.global_remaps = std::move(outer.global_remaps);
  }
}

}  // namespace launch
