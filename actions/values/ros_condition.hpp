// SPDX-License-Identifier: Apache-2.0
// A condition of the ROS graph, as <depends_on> and <wait_for> have it: a node, a topic or a service, and its state.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/ros/ros_client.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The value of a literal attribute as its index in `names`. It must be one of them; without a value it is the first.
// Throws LaunchError.
std::size_t choice(const Fields& fields, const std::string& attribute, const std::vector<std::string>& names);

class RosCondition {
 public:
  // The attributes node, topic, service, state, parameter and value. The tag itself declares `condition`.
  static std::vector<AttributeSpec> attributes();

  // The name of the attribute that gives the subject: one of these, or one of `others`. Throws LaunchError at `fields`
  // when none is given, at the second when there are two.
  static std::string subject_of(const Fields& fields, const std::vector<std::string>& others);

  // Makes a condition for a subject of the graph. Throws LaunchError when attributes don't go together.
  RosCondition(const Fields& fields, const std::string& subject);

  std::shared_ptr<ReadinessCondition> perform(LaunchContext& context) const;

 private:
  enum class Kind { kNode, kState, kParameter, kTopic, kMessage, kService };

  static Kind kind_of(const Fields& fields, const std::string& subject);
  RosRequest request(Scope& scope) const;

  Kind kind_;
  Template name_;
  std::optional<Template> state_;
  std::optional<Template> parameter_;
  std::optional<Template> value_;
};

}  // namespace launch
