// SPDX-License-Identifier: Apache-2.0
#include "actions/values/ros_condition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actions/values/ros_names.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/ros/ros_readiness.hpp"

namespace launch {

namespace {

const std::vector<std::string> kSubjects = {"node", "topic", "service"};
const std::vector<std::string> kStates = {"unconfigured", "inactive", "active", "finalized"};

void require_state(const std::string& name, const SourceRange& where) {
  if (std::find(kStates.begin(), kStates.end(), name) == kStates.end()) {
    throw LaunchError(fmt::format("state can be unconfigured, inactive, active or finalized, got '{}'", name), where,
                      did_you_mean(name, kStates));
  }
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

std::vector<AttributeSpec> RosCondition::attributes() {
  return {{"node", AttributeType::kText, false, "", "a node of the ROS graph, of this launch or not", true},
          {"topic", AttributeType::kText, false, "", "instead of a node: a topic", true},
          {"service", AttributeType::kText, false, "", "instead of a node: a service", true},
          {"state", AttributeType::kText, false, "any",
           "with node: the state of its life cycle, unconfigured, inactive, active or finalized", true},
          {"parameter", AttributeType::kText, false, "none", "with node: a parameter that has a value", true},
          {"value", AttributeType::kText, false, "", "with parameter: the value as YAML", true}};
}

std::string RosCondition::subject_of(const Fields& fields, const std::vector<std::string>& others) {
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

RosCondition::Kind RosCondition::kind_of(const Fields& fields, const std::string& subject) {
  if (subject == "topic") {
    return choice(fields, "condition", {"present", "message"}) == 0 ? Kind::kTopic : Kind::kMessage;
  }
  choice(fields, "condition", {"present"});
  if (subject == "service") {
    return Kind::kService;
  }
  return fields.has("state") ? Kind::kState : fields.has("parameter") ? Kind::kParameter : Kind::kNode;
}

RosCondition::RosCondition(const Fields& fields, const std::string& subject)
    : kind_(kind_of(fields, subject)),
      name_(fields.text(subject)),
      state_(fields.optional_text("state")),
      parameter_(fields.optional_text("parameter")),
      value_(fields.optional_text("value")) {
  if (parameter_ && subject != "node") {
    throw LaunchError("parameter goes with a node only", fields.where("parameter"), {}, Finding::kExclusive);
  }
  if (parameter_ && state_) {
    throw LaunchError("either a state or a parameter is waited for", fields.where("parameter"), "write one for each",
                      Finding::kExclusive);
  }
  if (value_ && !parameter_) {
    throw LaunchError("value goes with a parameter only", fields.where("value"), "give parameter=\"…\", its name",
                      Finding::kExclusive);
  }
  if (parameter_ && !value_) {
    throw LaunchError("the parameter has no value that is waited for", fields.where("parameter"), "give value=\"…\"",
                      Finding::kMissingAttribute);
  }
  if (state_ && kind_ != Kind::kState) {
    throw LaunchError("state goes with a node only", fields.where("state"), {}, Finding::kExclusive);
  }
  if (state_ && state_->is_literal()) {
    Scope nothing;
    require_state(state_->perform(nothing), state_->where());
  }
}

std::shared_ptr<ReadinessCondition> RosCondition::perform(LaunchContext& context) const {
  Scope& scope = context.scope();
  return std::make_shared<RosReadiness>(context.ros_client(), request(scope), scope.environment);
}

RosRequest RosCondition::request(Scope& scope) const {
  const std::string name = resolve_name(name_, scope);
  switch (kind_) {
    case Kind::kNode:
      return NodePresent{name};
    case Kind::kTopic:
      return TopicPresent{name};
    case Kind::kMessage:
      return MessagePublished{name};
    case Kind::kService:
      return ServicePresent{name};
    case Kind::kParameter:
      return ParameterReached{name,
                              {parameter_->perform(scope), typed_parameter(value_->perform(scope), value_->where())}};
    case Kind::kState:
      break;
  }
  const std::string state = state_->perform(scope);
  require_state(state, state_->where());
  return StateReached{name, state};
}

}  // namespace launch
