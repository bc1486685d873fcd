// SPDX-License-Identifier: Apache-2.0
// <set_env>, <unset_env>, <append_env>, <reset_env> and <rep_env>: the launch environment, which $(env …) reads and
// later processes inherit.
#include <fmt/format.h>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetEnvironmentVariable : public Action {
 public:
  explicit SetEnvironmentVariable(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")), value_(fields.text("value")) {}

 protected:
  void execute(LaunchContext& context) const override {
    std::string name = name_.perform(context.scope());
    if (name.empty() || name.find('=') != std::string::npos) {
      throw LaunchError(fmt::format("'{}' is no name of an environment variable", name), name_.where(),
                        name.empty() ? "" : "the name and the value are two attributes");
    }
    std::string value = value_.perform(context.scope());
    context.scope().environment.insert_or_assign(std::move(name), std::move(value));
  }

 private:
  Template name_;
  Template value_;
};

class UnsetEnvironmentVariable : public Action {
 public:
  explicit UnsetEnvironmentVariable(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")) {}

 protected:
  void execute(LaunchContext& context) const override {
    context.scope().environment.erase(name_.perform(context.scope()));
  }

 private:
  Template name_;
};

class AppendEnvironmentVariable : public Action {
 public:
  explicit AppendEnvironmentVariable(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        name_(fields.text("name")),
        value_(fields.text("value")),
        prepend_(fields.boolean("prepend", false)),
        separator_(fields.optional_text("separator")) {}

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    const std::string name = name_.perform(scope);
    const std::string value = value_.perform(scope);
    const bool prepend = prepend_.perform(scope);
    const std::string separator = separator_ ? separator_->perform(scope) : ":";
    if (!scope.environment.contains(name)) {
      scope.environment.insert_or_assign(name, value);
      return;
    }
    const std::string& before = scope.environment.at(name);
    scope.environment.insert_or_assign(name, prepend ? value + separator + before : before + separator + value);
  }

 private:
  Template name_;
  Template value_;
  BooleanField prepend_;
  std::optional<Template> separator_;
};

class ResetEnvironment : public Action {
 public:
  explicit ResetEnvironment(const Fields& fields) : Action(fields.where(), fields.condition()) {}

 protected:
  void execute(LaunchContext& context) const override { context.scope().environment = context.initial_environment(); }
};

class ReplaceEnvironment : public Action {
 public:
  explicit ReplaceEnvironment(const Fields& fields) : Action(fields.where(), fields.condition()) {
    for (const Fields* variable : fields.items("env")) {
      variables_.emplace_back(variable->text("name"), variable->text("value"));
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Environment environment;
    for (const auto& [name, value] : variables_) {
      environment.insert_or_assign(name.perform(context.scope()), value.perform(context.scope()));
    }
    context.scope().environment = std::move(environment);
  }

 private:
  std::vector<std::pair<Template, Template>> variables_;
};

}  // namespace

ActionType append_env_action() {
  return {
      .tag = "append_env",
      .help = "Appends a value to a variable of the launch environment, or sets it.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the variable"},
                     {"value", AttributeType::kText, true, "", "the text to append"},
                     {"prepend", AttributeType::kBoolean, false, "false", "true: put the value in front"},
                     {"separator", AttributeType::kText, false, ":", "text between the values"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<AppendEnvironmentVariable>(fields); },
  };
}

ActionType reset_env_action() {
  return {
      .tag = "reset_env",
      .help = "Restores the environment that the launcher was started with.",
      .attributes = {},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<ResetEnvironment>(fields); },
  };
}

ActionType rep_env_action() {
  return {
      .tag = "rep_env",
      .help = "Replaces the whole launch environment.",
      .attributes = {},
      .items = {{"env",
                 "a variable of the new environment",
                 {{"name", AttributeType::kText, true, "", "name of the variable"},
                  {"value", AttributeType::kText, true, "", "its value"}}}},
      .make = [](const Fields& fields) { return std::make_shared<ReplaceEnvironment>(fields); },
  };
}

ActionType set_env_action() {
  return {
      .tag = "set_env",
      .help = "Sets a variable of the launch environment.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the variable"},
                     {"value", AttributeType::kText, true, "", "its value"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetEnvironmentVariable>(fields); },
  };
}

ActionType unset_env_action() {
  return {
      .tag = "unset_env",
      .help = "Removes a variable from the launch environment.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the variable"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<UnsetEnvironmentVariable>(fields); },
  };
}

}  // namespace launch
