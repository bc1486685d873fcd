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
    }
    const std::vector<std::string>& choices = declaration_.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value->second) == choices.end()) {
      throw LaunchError(fmt::format("argument \"{}\" provided value \"{}\" is not valid. Valid options are: ['{}']",
                                    declaration_.name, value->second, fmt::join(choices, "', '")),
                        where(), did_you_mean(value->second, choices), Finding::kArgument);
    }
  }

 private:
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
