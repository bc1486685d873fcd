// SPDX-License-Identifier: Apache-2.0
// <depends_on …/> of a process: what it waits for before it starts.
#pragma once

#include <optional>
#include <string>

#include "actions/ros_condition.hpp"
#include "launcher/language/fields.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class DependsOn {
 public:
  // The declaration for the ActionType of a process.
  static ItemSpec item();

  // Throws LaunchError when attributes don't go together.
  explicit DependsOn(const Fields& fields);

  // If its condition holds, evaluates the item for the process with this number among the requests.
  void request(LaunchContext& context, std::size_t process) const;

 private:
  enum class State { kStarted, kExited, kOutput };

  ProcessCondition process_condition(Scope& scope) const;

  SourceRange where_;
  Condition condition_;
  std::optional<RosCondition> ros_condition_;  // without it, the item is about a process
  std::optional<Template> process_;
  State state_ = State::kStarted;
  std::optional<Template> exit_code_;
  std::optional<Template> pattern_;
  std::optional<Template> stream_;
  std::optional<NumberField> timeout_;
  OnFailure on_failure_ = OnFailure::kShutdown;
};

}  // namespace launch
