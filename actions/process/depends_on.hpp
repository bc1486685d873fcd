// SPDX-License-Identifier: Apache-2.0
// <depends_on …/> of a process: what it waits for before it starts; and of a fault, what it waits for before it is
// applied.
#pragma once

#include <optional>
#include <string>

#include "actions/values/range_field.hpp"
#include "actions/values/ros_condition.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class DependsOn {
 public:
  // The declaration for the ActionType of a process.
  static ItemSpec item();
  // And for that of a fault.
  static ItemSpec item_of_fault();

  // Throws LaunchError when attributes don't go together.
  explicit DependsOn(const Fields& fields);

  // If its condition holds, evaluates the item for the process with this number among the requests.
  void request(LaunchContext& context, std::size_t process) const;

  // Of a fault, whose item has this number: a range of occurrences is allowed, and `draw` chooses one.
  std::optional<Dependency> perform(LaunchContext& context, const FaultDraw& draw, std::size_t number) const;
  bool is_random(Scope& scope) const;

 private:
  enum class State { kStarted, kExited, kOutput, kHealthy };

  NumberRange occurrence(Scope& scope) const;
  Dependency dependency(LaunchContext& context, std::uint64_t occurrence) const;
  ProcessCondition process_condition(Scope& scope, std::uint64_t occurrence) const;

  Fields fields_;
  std::string subject_;  // the attribute that gives it: process, or one of the ROS graph
  State state_ = State::kStarted;
  OnFailure on_failure_ = OnFailure::kShutdown;
};

}  // namespace launch
