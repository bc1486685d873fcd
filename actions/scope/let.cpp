// SPDX-License-Identifier: Apache-2.0
// <let name="…" value="…"/> and <unset name="…"/>: set and remove a launch configuration.
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetLaunchConfiguration : public Action {
 public:
  explicit SetLaunchConfiguration(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")), value_(fields.text("value")) {}

 protected:
  void execute(LaunchContext& context) const override {
    std::string name = name_.perform(context.scope());
    std::string value = value_.perform(context.scope());
    context.scope().configurations.insert_or_assign(std::move(name), std::move(value));
  }

 private:
  Template name_;
  Template value_;
};

class UnsetLaunchConfiguration : public Action {
 public:
  explicit UnsetLaunchConfiguration(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")) {}

 protected:
  void execute(LaunchContext& context) const override {
    context.scope().configurations.erase(name_.perform(context.scope()));
  }

 private:
  Template name_;
};

}  // namespace

ActionType unset_action() {
  return {
      .tag = "unset",
      .help = "Removes a launch configuration; no error when there is none.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the configuration"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<UnsetLaunchConfiguration>(fields); },
  };
}

ActionType let_action() {
  return {
      .tag = "let",
      .help = "Sets a launch configuration, whatever it was before.",
      .attributes = {{"name", AttributeType::kText, true, "", "name of the configuration"},
                     {"value", AttributeType::kText, true, "", "its value"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetLaunchConfiguration>(fields); },
  };
}

}  // namespace launch
