// SPDX-License-Identifier: Apache-2.0
// <publish>, <clock>, <receive>, <call>, <send_goal>, <change_parameter>, <transition>: steps that take part in the ROS
// graph, each a process that runs the command of the same kind (`launch topic pub`, …). So they can start at a time,
// when something is ready or after another step, and their end tells whether they have succeeded.
#include <fmt/format.h>

#include <functional>

#include "actions/process/machine_settings.hpp"
#include "actions/process/process_settings.hpp"
#include "actions/values/message_texts.hpp"
#include "actions/values/ros_names.hpp"
#include "launcher/message_types/interface_library.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/message_types/read_value.hpp"
#include "launcher/ros/ros_program.hpp"

namespace launch {

namespace {

constexpr const char* kProgram = "launch-ros-command";

// The message type of which the values of a step, or its condition, are; its argument is what the attribute `type`
// says.
using TypeOfValues = std::function<std::shared_ptr<const MessageType>(InterfaceLibrary&, const std::string&)>;

struct StepType {
  std::string tag;
  std::string help;
  std::vector<AttributeSpec> attributes;
  std::vector<std::string> command;  // "topic", "pub"
  std::vector<std::string> words;    // attributes whose values are the words behind it, in order
  struct Number {
    std::string option, attribute;
    double value;  // if the attribute is not given
  };
  std::vector<Number> numbers = {};
  TypeOfValues type_of_values = {};
  // Looks for mistakes in the last word. Throws LaunchError at its place.
  void (*check_last)(const std::string& word, const SourceRange& where) = nullptr;
};

class RosStep : public Action {
 public:
  RosStep(const Fields& fields, const StepType& type)
      : Action(fields.where(), fields.condition()),
        type_(type),
        fields_(fields),
        condition_(fields.optional_text("where")) {
    check_process(fields_);
    for (const std::string& word : type_.words) {
      words_.push_back(fields.optional_text(word));
    }
    for (const StepType::Number& number : type_.numbers) {
      numbers_.push_back(fields.number(number.attribute));
      if (numbers_.back()) {
        numbers_.back()->require_not_negative();
      }
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    // It asks nodes from here, wherever they run.
    Environment graph = graph_environment(context.scope(), context.scope().environment);
    const AtMachine here(context, nullptr);
    Scope& scope = context.scope();
    scope.environment = std::move(graph);
    std::vector<std::string> words;
    for (const std::optional<Template>& word : words_) {
      words.push_back(word ? word->perform(scope) : "{}");
    }
    const std::string condition = condition_ ? condition_->perform(scope) : "";
    if (type_.type_of_values) {
      check(scope, words, condition);
    }
    if (type_.check_last != nullptr) {
      type_.check_last(words.back(), words_.back()->where());
    }
    ProcessSpec spec;
    at_place(where(), [&] { spec.argv = {ros_program(kProgram, scope.environment)}; });
    spec.argv.insert(spec.argv.end(), type_.command.begin(), type_.command.end());
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const StepType::Number& number = type_.numbers[i];
      const double value = numbers_[i] ? numbers_[i]->perform(scope) : number.value;
      spec.argv.push_back(fmt::format("{}={}", number.option, value));
    }
    if (condition_) {
      spec.argv.push_back("--filter=" + condition);
    }
    if (!words.empty()) {
      spec.argv.emplace_back("--");
    }
    spec.argv.insert(spec.argv.end(), words.begin(), words.end());
    spec.name = fields_.has("name") ? fields_.text("name").perform(scope) : type_.tag;
    request_process(fields_, context, std::move(spec));
  }

 private:
  // Looks for mistakes in the type, the values and the condition.
  void check(Scope& scope, const std::vector<std::string>& words, const std::string& condition) const {
    const std::size_t type_at = 1;  // behind the name
    InterfaceLibrary library(*scope.packages, scope.environment);
    std::shared_ptr<const MessageType> type;
    at_place(words_[type_at]->where(), [&] { type = type_.type_of_values(library, words[type_at]); });
    if (words.size() > type_at + 1 && words_.back()) {
      const SourceRange& where = words_.back()->where();
      at_place(where, [&] { (void)read_message(*type, located(words.back(), where)); });
    }
    if (condition_) {
      at_place(condition_->where(), [&] { MessageCondition(type, located(condition, condition_->where())); });
    }
  }

  const StepType& type_;
  Fields fields_;
  std::vector<std::optional<Template>> words_;
  std::vector<std::optional<NumberField>> numbers_;
  std::optional<Template> condition_;
};

AttributeSpec text(const char* name, const char* help) {
  return {name, AttributeType::kText, true, "", help};
}

AttributeSpec values(const char* help) {
  return {"values", AttributeType::kText, false, "{}", help};
}

// The declaration lives as long as the program, as `type` does.
ActionType action_of(const StepType& type) {
  std::vector<AttributeSpec> attributes = type.attributes;
  attributes.push_back({"name", AttributeType::kText, false, type.tag, "label of the process"});
  return {.tag = type.tag,
          .help = type.help,
          .attributes = with_process_attributes(std::move(attributes)),
          .items = process_items(),
          .extension = true,
          .make = [&type](const Fields& fields) { return std::make_shared<RosStep>(fields, type); }};
}

}  // namespace

ActionType publish_action() {
  static const StepType type = {
      .tag = "publish",
      .help = "Publishes messages on a topic, once somebody subscribes to it.",
      .attributes = {text("topic", "name of the topic"),
                     text("type", "type of the messages"),
                     values("the message as YAML"),
                     {"rate", AttributeType::kFloat, false, "1", "messages in a second"},
                     {"count", AttributeType::kInteger, false, "1", "so many messages; 0: until it is ended"}},
      .command = {"topic", "pub"},
      .words = {"topic", "type", "values"},
      .numbers = {{"--rate", "rate", 1}, {"--times", "count", 1}},
      .type_of_values = [](InterfaceLibrary& library, const std::string& name) { return library.message(name); }};
  return action_of(type);
}

ActionType clock_action() {
  static const StepType type = {
      .tag = "clock",
      .help = "Publishes simulated time on /clock until it is ended. Faults can stop, skew and jump it.",
      .attributes = {{"rate", AttributeType::kFloat, false, "1", "seconds of simulated time in a second"},
                     {"start", AttributeType::kFloat, false, "0", "the first time, in seconds"},
                     {"frequency", AttributeType::kFloat, false, "100", "messages in a second"}},
      .command = {"clock"},
      .words = {},
      .numbers = {{"--rate", "rate", 1}, {"--start", "start", 0}, {"--frequency", "frequency", 100}}};
  return action_of(type);
}

ActionType receive_action() {
  static const StepType type = {
      .tag = "receive",
      .help = "Waits for a message on a topic, and prints it.",
      .attributes = {text("topic", "name of the topic"),
                     text("type", "type of the messages"),
                     {"where", AttributeType::kText, false, "", "only a message of which this holds: data > 3"}},
      .command = {"topic", "echo", "--once"},
      .words = {"topic", "type"},
      .type_of_values = [](InterfaceLibrary& library, const std::string& name) { return library.message(name); }};
  return action_of(type);
}

ActionType call_action() {
  static const StepType type = {.tag = "call",
                                .help = "Calls a service, once it is there.",
                                .attributes = {text("service", "name of the service"),
                                               text("type", "type of the service"), values("the request as YAML")},
                                .command = {"service", "call"},
                                .words = {"service", "type", "values"},
                                .type_of_values = [](InterfaceLibrary& library, const std::string& name) {
                                  return library.service(name).request;
                                }};
  return action_of(type);
}

ActionType send_goal_action() {
  static const StepType type = {
      .tag = "send_goal",
      .help = "Sends a goal to an action, once its server is there, and waits for the result.",
      .attributes = {text("action", "name of the action"), text("type", "type of the action"),
                     values("the goal as YAML")},
      .command = {"action", "send_goal"},
      .words = {"action", "type", "values"},
      .type_of_values = [](InterfaceLibrary& library, const std::string& name) {
        return library.message(name + "_Goal");
      }};
  return action_of(type);
}

ActionType change_parameter_action() {
  static const StepType type = {
      .tag = "change_parameter",
      .help = "Changes a parameter of a node that runs, once the node is there.",
      .attributes = {text("node", "name of the node"), text("parameter", "name of the parameter"),
                     text("value", "its value as YAML")},
      .command = {"param", "set", "--timeout=60"},
      .words = {"node", "parameter", "value"}};
  return action_of(type);
}

ActionType transition_action() {
  static const StepType type = {
      .tag = "transition",
      .help = "Changes the state of a node with a managed life cycle, once the node is there.",
      .attributes = {text("node", "name of the node"),
                     text("transition", "configure, activate, deactivate, cleanup or shutdown")},
      .command = {"lifecycle", "set", "--spin-time=60"},
      .words = {"node", "transition"},
      .check_last = require_transition};
  return action_of(type);
}

}  // namespace launch
