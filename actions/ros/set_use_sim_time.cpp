// SPDX-License-Identifier: Apache-2.0
// <set_use_sim_time value="…"/>: whether the launcher's own ros_timer counts simulated time.
#include <fmt/format.h>

#include "launcher/language/fields.hpp"
#include "launcher/substitution/boolean.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class SetUseSimTime : public Action {
 public:
  explicit SetUseSimTime(const Fields& fields)
      : Action(fields.where(), fields.condition()), value_(fields.text("value")) {}

 protected:
  void execute(LaunchContext& context) const override {
    const std::string text = value_.perform(context.scope());
    const std::optional<bool> value = yaml_boolean(text);
    if (!value) {
      throw LaunchError(fmt::format("expected a boolean, got '{}'", text), value_.where(), "write true or false");
    }
    if (*value) {
      context.scope().warn(value_.where(),
                           "set_use_sim_time has no effect: ros_timer counts system time. For nodes, use "
                           "set_parameter with use_sim_time");
    }
  }

 private:
  Template value_;
};

}  // namespace

ActionType set_use_sim_time_action() {
  return {
      .tag = "set_use_sim_time",
      .help = "Has no effect, and warns if true: this launcher counts system time. Launched nodes are not concerned.",
      .attributes = {{"value", AttributeType::kText, true, "", "true or false"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<SetUseSimTime>(fields); },
  };
}

}  // namespace launch
