// SPDX-License-Identifier: Apache-2.0
// <arg name="…" default="…"/> and <bool_arg …/>: declare a launch argument. A value that is set already is kept.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class DeclareLaunchArgument : public Action {
 public:
  explicit DeclareLaunchArgument(const Fields& fields, std::vector<std::string> choices = {})
      : Action(fields.where(), fields.condition()) {
    declaration_.choices = std::move(choices);
    declaration_.name = fields.literal("name");
    declaration_.default_value = fields.optional_text("default");
    declaration_.description = fields.literal("description");
    for (const Fields* choice : fields.items("choice")) {
      declaration_.choices.push_back(choice->literal("value"));
    }
    declaration_.where = fields.where();
  }

  Introspection introspect() const override { return {.argument = &declaration_}; }

 protected:
  void execute(LaunchContext& context) const override {
    auto& configurations = context.scope().configurations;
    auto value = configurations.find(declaration_.name);
    if (value == configurations.end()) {
      if (!declaration_.default_value) {
        throw LaunchError(fmt::format("required launch argument \"{}\" was not provided", declaration_.name), where(),
                          fmt::format("give it on the command line: {}:=…", declaration_.name), Finding::kArgument);
      }
      value = configurations.emplace(declaration_.name, declaration_.default_value->perform(context.scope())).first;
      context.exploration().note_default(declaration_.name, where(), value->second);
    } else if (context.exploration().is_on() && declaration_.default_value) {
      find_ignored_default(value->second, context);
    }
    const std::vector<std::string>& choices = declaration_.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value->second) == choices.end()) {
      throw LaunchError(fmt::format("argument \"{}\" provided value \"{}\" is not valid. Valid options are: ['{}']",
                                    declaration_.name, value->second, fmt::join(choices, "', '")),
                        where(), did_you_mean(value->second, choices), Finding::kArgument);
    }
  }

 private:
  // An argument of this name in a file that was included before, beside this one, has taken its default. It holds here,
  // too, which hardly anybody means. That the default of a file around this one holds is usual.
  void find_ignored_default(const std::string& value, LaunchContext& context) const {
    const auto* const first = context.exploration().defaulted(declaration_.name);
    if (first == nullptr || first->value != value || first->where.file == nullptr || where().file == nullptr ||
        leads_here(first->where.file->path()) || context.exploration().is_settings_file(first->where.file->path())) {
      return;
    }
    std::string own;
    try {
      Scope scope = context.scope();
      own = declaration_.default_value->perform(scope);
    } catch (const LaunchError&) {
      return;
    }
    if (own != value) {
      context.exploration().remark(
          {Severity::kWarning,
           fmt::format("the default '{}' of argument '{}' has no effect: it is '{}'", own, declaration_.name, value),
           declaration_.default_value->where(),
           fmt::format("{} has set it, and an include is no scope: write scoped=\"true\" there, or give the argument "
                       "with the include",
                       to_string(first->where)),
           Finding::kIgnoredDefault});
    }
  }

  // Whether the file is this one, or one around it.
  bool leads_here(const std::string& path) const {
    for (const SourceRange* place = &where(); place->file != nullptr; place = &place->file->included_from()) {
      if (place->file->path() == path) {
        return true;
      }
    }
    return false;
  }

  ArgumentDeclaration declaration_;
};

std::vector<AttributeSpec> argument_attributes() {
  return {{"name", AttributeType::kLiteral, true, "", "name of the configuration"},
          {"default", AttributeType::kText, false, "",
           "value when none is given; without a default the argument is required"},
          {"description", AttributeType::kLiteral, false, "no description given", "shown by --show-args"}};
}

}  // namespace

ActionType bool_arg_action() {
  return {
      .tag = "bool_arg",
      .help = "Declares a launch argument that is true or false.",
      .attributes = argument_attributes(),
      .make =
          [](const Fields& fields) {
            const std::vector<std::string> choices = {"true", "false", "True", "False", "TRUE", "FALSE"};
            return std::make_shared<DeclareLaunchArgument>(fields, choices);
          },
  };
}

ActionType arg_action() {
  return {
      .tag = "arg",
      .help = "Declares a launch argument. A value given from outside, or set before, is kept.",
      .attributes = argument_attributes(),
      .items = {{"choice", "an allowed value", {{"value", AttributeType::kLiteral, true, "", "the value"}}}},
      .make = [](const Fields& fields) { return std::make_shared<DeclareLaunchArgument>(fields); },
  };
}

}  // namespace launch
