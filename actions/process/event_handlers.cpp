// SPDX-License-Identifier: Apache-2.0
// <on_process_start>, <on_process_exit>, <on_process_io>, <on_shutdown>, <on_state_transition>: visit actions when
// something happens.
#include <fmt/format.h>

#include <algorithm>

#include "actions/values/ros_names.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

namespace {

constexpr double kDefaultShutdownTimeout = 5.0;  // seconds

using Event = decltype(EventHandler::event);

// The part that all event handlers have in common. `make_event` evaluates the rest each time the handler is visited.
class RegisterEventHandler : public Action {
 public:
  using MakeEvent = std::function<Event(Scope&)>;

  RegisterEventHandler(const Fields& fields, MakeEvent make_event)
      : Action(fields.where(), fields.condition()),
        name_(fields.optional_text("name")),
        process_(fields.optional_text("process")),
        once_(fields.boolean("once", false)),
        actions_(fields.actions()),
        make_event_(std::move(make_event)) {}

  Introspection introspect() const override { return {.children = &actions_, .children_may_not_run = true}; }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    EventHandler handler;
    handler.event = make_event_(scope);
    handler.name = name_ ? name_->perform(scope) : "";
    if (process_) {
      handler.process = process_->perform(scope);
      if (handler.process.empty()) {
        throw LaunchError("the name of the process is empty", process_->where(),
                          "leave the attribute out to mean every process");
      }
    }
    handler.once = once_.perform(scope);
    handler.actions = actions_;
    handler.scope = scope;
    handler.where = where();
    context.requests().handlers.push_back(std::move(handler));
  }

 private:
  std::optional<Template> name_;
  std::optional<Template> process_;
  BooleanField once_;
  std::vector<ActionPtr> actions_;
  MakeEvent make_event_;
};

// Evaluates literal attributes now, so that their errors are found at load.
RegisterEventHandler::MakeEvent checked(RegisterEventHandler::MakeEvent make_event, bool literal) {
  if (literal) {
    Scope nothing;
    make_event(nothing);
  }
  return make_event;
}

bool needs_no_visit(const std::optional<Template>& text) {
  return !text || text->is_literal();
}

ActionPtr make_on_process_exit(const Fields& fields) {
  const std::optional<Template> exit_code = fields.optional_text("exit_code");
  auto make_event = [exit_code](Scope& scope) -> Event {
    return OnProcessExit{exit_code ? ExitCodeFilter(exit_code->perform(scope), exit_code->where()) : ExitCodeFilter()};
  };
  return std::make_shared<RegisterEventHandler>(fields, checked(make_event, needs_no_visit(exit_code)));
}

ActionPtr make_on_process_io(const Fields& fields) {
  const std::optional<Template> pattern = fields.optional_text("pattern");
  const std::optional<Template> stream = fields.optional_text("stream");
  RegisterEventHandler::MakeEvent make_event = [pattern, stream](Scope& scope) -> Event {
    return OnProcessIo{OutputPattern(pattern ? pattern->perform(scope) : "", pattern ? pattern->where() : SourceRange(),
                                     stream ? stream->perform(scope) : "both",
                                     stream ? stream->where() : SourceRange())};
  };
  return std::make_shared<RegisterEventHandler>(
      fields, checked(std::move(make_event), needs_no_visit(pattern) && needs_no_visit(stream)));
}

ActionPtr make_on_shutdown(const Fields& fields) {
  std::optional<NumberField> timeout = fields.number("timeout");
  if (timeout) {
    timeout->require_not_negative();
  }
  return std::make_shared<RegisterEventHandler>(fields, [timeout](Scope& scope) -> Event {
    const std::chrono::duration<double> seconds(timeout ? timeout->perform(scope) : kDefaultShutdownTimeout);
    return OnShutdown{std::chrono::duration_cast<Duration>(seconds)};
  });
}

// The states that a node stays in, and the states that it passes through.
const std::vector<std::string> kStates = {"unconfigured", "inactive",       "active",     "finalized",
                                          "configuring",  "cleaningup",     "activating", "deactivating",
                                          "shuttingdown", "errorprocessing"};

std::string state_of(const std::optional<Template>& given, Scope& scope) {
  if (!given) {
    return {};
  }
  std::string state = given->perform(scope);
  if (std::find(kStates.begin(), kStates.end(), state) == kStates.end()) {
    throw LaunchError(fmt::format("a node with a managed life cycle has no state '{}'", state), given->where(),
                      did_you_mean(state, kStates));
  }
  return state;
}

ActionPtr make_on_state_transition(const Fields& fields) {
  const Template& node = fields.text("node");
  const std::optional<Template> start = fields.optional_text("start_state");
  const std::optional<Template> goal = fields.optional_text("goal_state");
  for (const std::optional<Template>& state : {start, goal}) {
    if (Scope nothing; needs_no_visit(state)) {
      state_of(state, nothing);
    }
  }
  return std::make_shared<RegisterEventHandler>(fields, [node, start, goal](Scope& scope) -> Event {
    return OnStateTransition{resolve_name(node, scope), state_of(start, scope), state_of(goal, scope)};
  });
}

ActionType handler(std::string tag, std::string help, std::vector<AttributeSpec> attributes,
                   std::function<ActionPtr(const Fields&)> make) {
  attributes.push_back({"name", AttributeType::kText, false, "", "name of the handler, for unregister_event_handler"});
  for (AttributeSpec& attribute : attributes) {
    attribute.extension = true;
  }
  return {.tag = std::move(tag),
          .help = std::move(help),
          .attributes = std::move(attributes),
          .items = {},
          .holds_actions = true,
          .extension = true,
          .make = std::move(make)};
}

AttributeSpec any_process_attribute() {
  return {"process", AttributeType::kText, false, "every process", "name of the process or of its node"};
}

AttributeSpec once_attribute() {
  return {"once", AttributeType::kBoolean, false, "false", "true: only the first time"};
}

}  // namespace

ActionType on_process_start_action() {
  return handler("on_process_start", "Visits its actions each time a process has started.",
                 {any_process_attribute(), once_attribute()}, [](const Fields& fields) {
                   return std::make_shared<RegisterEventHandler>(fields,
                                                                 [](Scope&) -> Event { return OnProcessStart{}; });
                 });
}

ActionType on_process_exit_action() {
  return handler("on_process_exit",
                 "Visits its actions each time a process has ended; a process that can't be started counts as ended "
                 "with exit code 127.",
                 {any_process_attribute(),
                  {"exit_code", AttributeType::kText, false, "any",
                   "any, nonzero, or codes and signals (-9 or SIGKILL) separated by commas"},
                  once_attribute()},
                 make_on_process_exit);
}

ActionType on_process_io_action() {
  return handler("on_process_io", "Visits its actions for each line that a process has written.",
                 {any_process_attribute(),
                  {"pattern", AttributeType::kText, false, "every line", "regular expression to be found in the line"},
                  {"stream", AttributeType::kText, false, "both", "stdout, stderr or both"},
                  once_attribute()},
                 make_on_process_io);
}

ActionType on_shutdown_action() {
  return handler("on_shutdown",
                 "Visits its actions when the system is about to end; processes that they start run before the others "
                 "are asked to end.",
                 {{"timeout", AttributeType::kFloat, false, "5", "seconds that these processes may take"}},
                 make_on_shutdown);
}

ActionType on_state_transition_action() {
  return handler("on_state_transition",
                 "Visits its actions each time a node with a managed life cycle has changed its state.",
                 {{"node", AttributeType::kText, true, "",
                   "the node, of this launch or not; a relative name is below the namespace of the scope"},
                  {"start_state", AttributeType::kText, false, "any", "the state that the node has left"},
                  {"goal_state", AttributeType::kText, false, "any", "the state that the node has reached"},
                  once_attribute()},
                 make_on_state_transition);
}

}  // namespace launch
