// SPDX-License-Identifier: Apache-2.0
// <shutdown/>: ends the whole launch.
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class Shutdown : public Action {
 public:
  explicit Shutdown(const Fields& fields)
      : Action(fields.where(), fields.condition()), reason_(fields.optional_text("reason")) {}

 protected:
  void execute(LaunchContext& context) const override {
    context.requests().shutdowns.push_back({reason_ ? reason_->perform(context.scope()) : "reason not given"});
  }

 private:
  std::optional<Template> reason_;
};

}  // namespace

ActionType shutdown_action() {
  return {
      .tag = "shutdown",
      .help = "Ends the whole launch once everything around it has been visited.",
      .attributes = {{"reason", AttributeType::kText, false, "", "why, for the launch log"}},
      .items = {},
      .make = [](const Fields& fields) { return std::make_shared<Shutdown>(fields); },
  };
}

}  // namespace launch
