// SPDX-License-Identifier: Apache-2.0
// <unregister_event_handler name="…"/>: an event handler gets no more events.
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

class UnregisterEventHandler : public Action {
 public:
  explicit UnregisterEventHandler(const Fields& fields)
      : Action(fields.where(), fields.condition()), name_(fields.text("name")) {}

 protected:
  void execute(LaunchContext& context) const override {
    const std::string name = name_.perform(context.scope());
    // A handler of the same traversal is not registered yet.
    if (std::erase_if(context.requests().handlers, [&](const EventHandler& handler) { return handler.name == name; }) ==
        0) {
      context.requests().unregistered.push_back({name, name_.where()});
    }
  }

 private:
  Template name_;
};

}  // namespace

ActionType unregister_event_handler_action() {
  return {.tag = "unregister_event_handler",
          .help = "Removes the event handlers of a name; the processes that they started run on.",
          .attributes = {{"name", AttributeType::kText, true, "", "name of the handlers", true}},
          .items = {},
          .extension = true,
          .make = [](const Fields& fields) { return std::make_shared<UnregisterEventHandler>(fields); }};
}

}  // namespace launch
