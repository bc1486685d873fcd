// SPDX-License-Identifier: Apache-2.0
// A condition that a process waits for before it starts: one `depends_on` of a launch file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "launcher/language/output_pattern.hpp"
#include "launcher/language/readiness_condition.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

class ProcessTable;
struct TrackedProcess;

struct UntilStarted {};
struct UntilExited {
  ExitCodeFilter exit_code;
};
struct UntilOutput {
  OutputPattern pattern;
  std::uint64_t occurrence = 1;  // the how many-th such line
};

struct UntilHealthy {};

// Another process of the launch.
struct ProcessCondition {
  std::string process;  // a name (process_table.hpp) that only one process has
  std::variant<UntilStarted, UntilExited, UntilOutput, UntilHealthy> state;
};

// What happens when a condition can't hold any more, or when its time is over.
enum class OnFailure { kShutdown, kStart, kSkip };

struct Dependency {
  std::size_t process = 0;  // the process that waits, as its index in the requested processes
  std::variant<ProcessCondition, std::shared_ptr<ReadinessCondition>> condition;
  std::optional<Duration> timeout;  // from the moment at which the process was asked for; nullopt: for ever
  OnFailure on_failure = OnFailure::kShutdown;
  SourceRange where;

  TrackedProcess* target = nullptr;  // of a ProcessCondition, set by resolve_dependencies()
};

// "'talker' has started", "'calibrate' has exited with code 0", "service /map/load is offered".
std::string describe(const Dependency& dependency);
// "shutdown", "start", "skip".
std::string_view to_string(OnFailure on_failure);

// Finds the processes that the conditions name and sets Dependency::target. A name means one of `asked_for`, or else
// the latest that was asked for before. Throws LaunchError with every name that is unknown or ambiguous.
void resolve_targets(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                     const ProcessTable& table);

// Does the same, and looks for cycles. `asked_for` are the processes that the dependencies belong to, already in the
// table. Throws LaunchError as before, and for a cycle.
void resolve_dependencies(std::vector<Dependency>& dependencies, const std::vector<TrackedProcess*>& asked_for,
                          const ProcessTable& table);

}  // namespace launch
