// SPDX-License-Identifier: Apache-2.0
#include "actions/values/ros_condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actions/values/ros_names.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/ros/ros_readiness.hpp"

namespace launch {

namespace {

enum class ConditionKind { kNode, kState, kParameter, kTopic, kMessage, kService };

const std::vector<std::string> kSubjects = {"node", "topic", "service"};
const std::vector<std::string> kLastingStates = {"unconfigured", "inactive", "active", "finalized"};

std::string perform_state(const Fields& fields, Scope& scope) {
  const Template& given = fields.text("state");
  std::string name = given.perform(scope);
  if (std::find(kLastingStates.begin(), kLastingStates.end(), name) == kLastingStates.end()) {
    throw LaunchError(fmt::format("state can be unconfigured, inactive, active or finalized, got '{}'", name),
                      given.where(), did_you_mean(name, kLastingStates));
  }
  return name;
}

ConditionKind kind_of(const Fields& fields, const std::string& subject) {
  if (subject == "topic") {
    return choice(fields, "condition", {"present", "message"}) == 0 ? ConditionKind::kTopic : ConditionKind::kMessage;
  }
  choice(fields, "condition", {"present"});
  if (subject == "service") {
    return ConditionKind::kService;
  }
  return fields.has("state")       ? ConditionKind::kState
         : fields.has("parameter") ? ConditionKind::kParameter
                                   : ConditionKind::kNode;
}

RosRequest request_of(const Fields& fields, const std::string& subject, Scope& scope) {
  const std::string name = resolve_name(fields.text(subject), scope);
  switch (kind_of(fields, subject)) {
    case ConditionKind::kNode:
      return NodePresent{name};
    case ConditionKind::kTopic:
      return TopicPresent{name};
    case ConditionKind::kMessage:
      return MessagePublished{name};
    case ConditionKind::kService:
      return ServicePresent{name};
    case ConditionKind::kParameter: {
      const Template& value = fields.text("value");
      return ParameterReached{
          name, {fields.text("parameter").perform(scope), typed_parameter(value.perform(scope), value.where())}};
    }
    case ConditionKind::kState:
      break;
  }
  return StateReached{name, perform_state(fields, scope)};
}

}  // namespace

std::size_t choice(const Fields& fields, const std::string& attribute, const std::vector<std::string>& names) {
  const std::string given = fields.literal(attribute, names.front());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (given == names[i]) {
      return i;
    }
  }
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  throw LaunchError(fmt::format("{} can be {}, got '{}'", attribute, list, given), fields.where(attribute),
                    did_you_mean(given, names));
}

std::vector<AttributeSpec> ros_condition_attributes() {
  return {{"node", AttributeType::kText, false, "", "a node of the ROS graph, of this launch or not", true},
          {"topic", AttributeType::kText, false, "", "instead of a node: a topic", true},
          {"service", AttributeType::kText, false, "", "instead of a node: a service", true},
          {"state", AttributeType::kText, false, "any",
           "with node: the state of its life cycle, unconfigured, inactive, active or finalized", true},
          {"parameter", AttributeType::kText, false, "none", "with node: a parameter that has a value", true},
          {"value", AttributeType::kText, false, "", "with parameter: the value as YAML", true}};
}

std::string ros_subject_of(const Fields& fields, const std::vector<std::string>& others) {
  std::vector<std::string> names = others;
  names.insert(names.end(), kSubjects.begin(), kSubjects.end());
  std::vector<std::string> given;
  std::copy_if(names.begin(), names.end(), std::back_inserter(given),
               [&](const std::string& name) { return fields.has(name); });
  if (given.empty()) {
    throw LaunchError("it is not said what is waited for", fields.where(),
                      fmt::format("give {}node, topic or service", others.empty() ? "" : others.front() + ", "),
                      Finding::kMissingAttribute);
  }
  if (given.size() > 1) {
    throw LaunchError(fmt::format("either a {} or a {} is waited for", given[0], given[1]), fields.where(given[1]),
                      "write one for each", Finding::kExclusive);
  }
  return given.front();
}

void check_ros_condition(const Fields& fields, const std::string& subject) {
  const ConditionKind kind = kind_of(fields, subject);
  const bool has_state = fields.has("state");
  const bool has_parameter = fields.has("parameter");
  if (has_parameter && subject != "node") {
    throw LaunchError("parameter goes with a node only", fields.where("parameter"), {}, Finding::kExclusive);
  }
  if (has_parameter && has_state) {
    throw LaunchError("either a state or a parameter is waited for", fields.where("parameter"), "write one for each",
                      Finding::kExclusive);
  }
  if (fields.has("value") && !has_parameter) {
    throw LaunchError("value goes with a parameter only", fields.where("value"), "give parameter=\"…\", its name",
                      Finding::kExclusive);
  }
  if (has_parameter && !fields.has("value")) {
    throw LaunchError("the parameter has no value that is waited for", fields.where("parameter"), "give value=\"…\"",
                      Finding::kMissingAttribute);
  }
  if (has_state && kind != ConditionKind::kState) {
    throw LaunchError("state goes with a node only", fields.where("state"), {}, Finding::kExclusive);
  }
  if (Scope nothing; has_state && fields.text("state").is_literal()) {
    perform_state(fields, nothing);
  }
}

std::shared_ptr<ReadinessCondition> perform_ros_condition(const Fields& fields, const std::string& subject,
                                                          LaunchContext& context) {
  Scope& scope = context.scope();
  return std::make_shared<RosReadiness>(context.ros_client(), request_of(fields, subject, scope),
                                        graph_environment(scope, scope.environment));
}

}  // namespace launch
