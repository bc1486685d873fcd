// SPDX-License-Identifier: Apache-2.0
// <set_parameter> and <set_parameters_from_file>: parameters of every later node of the scope.
#include <filesystem>

#include "launcher/language/fields.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetParameter : public Action {
 public:
  explicit SetParameter(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")), value_(fields.text("value")) {}

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    std::string name = name_.perform(scope);
    scope.global_parameters.push_back(
        NamedParameter{std::move(name), typed_parameter(value_.perform(scope), value_.where())});
  }

 private:
  Template name_;
  Template value_;
};

class SetParametersFromFile : public Action {
 public:
  explicit SetParametersFromFile(const Fields& fields)
      : Action(fields.where(), fields.condition()), filename_(fields.text("filename")) {}

 protected:
  void execute(LaunchContext& context) const override {
    // A missing file is an error only when a node gets it.
    const std::string name = filename_.perform(context.scope());
    const std::filesystem::path path = name.empty() ? "" : std::filesystem::absolute(name);
    context.scope().global_parameters.push_back(ParameterFilePath{path.lexically_normal().string(), filename_.where()});
  }

 private:
  Template filename_;
};

}  // namespace

ActionType set_parameter_action() {
  return {
      .tag = "set_parameter",
      .help = "Gives every later node of the scope a parameter.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the parameter"},
                     {"value", AttributeType::kText, true, "", "its value, typed by YAML 1.1 rules"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetParameter>(fields); },
  };
}

ActionType set_parameters_from_file_action() {
  return {
      .tag = "set_parameters_from_file",
      .help = "Gives every later node of the scope a parameter file.",
      .attributes = {{"filename", AttributeType::kText, true, "",
                      "path of the file; relative to the launcher's working directory"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetParametersFromFile>(fields); },
  };
}

}  // namespace launch
