// <set_env> and <unset_env>: the launch environment, which $(env …) reads and later processes inherit.
#include "launcher/core/fields.hpp"
#include "launcher/core/launch_context.hpp"

namespace launch {

namespace {

class SetEnvironmentVariable : public Action {
 public:
  explicit SetEnvironmentVariable(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")), value_(fields.text("value")) {}

 protected:
  void execute(LaunchContext& context) const override {
    std::string name = name_.perform(context.scope());
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

}  // namespace

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
