// SPDX-License-Identifier: Apache-2.0
// A condition of the ROS graph, as <depends_on> and <wait_for> have it: a node, a topic or a service, and its state.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/language/fields.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

// The value of a literal attribute as its index in `names`. It must be one of them; without a value it is the first.
// Throws LaunchError.
std::size_t choice(const Fields& fields, const std::string& attribute, const std::vector<std::string>& names);

// The attributes node, topic, service, state, parameter and value. The tag itself declares `condition`.
std::vector<AttributeSpec> ros_condition_attributes();

// The name of the attribute that gives the subject: one of node, topic and service, or one of `others`. Throws
// LaunchError at `fields` when none is given, at the second when there are two.
std::string ros_subject_of(const Fields& fields, const std::vector<std::string>& others = {});

// Throws LaunchError when attributes of a condition for a subject of the graph don't go together.
void check_ros_condition(const Fields& fields, const std::string& subject);
std::shared_ptr<ReadinessCondition> perform_ros_condition(const Fields& fields, const std::string& subject,
                                                          LaunchContext& context);

}  // namespace launch
