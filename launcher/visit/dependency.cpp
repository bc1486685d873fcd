// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/dependency.hpp"

#include <fmt/format.h>

#include "base/overloaded.hpp"

namespace launch {

std::string describe(const Dependency& dependency) {
  if (const auto* const readiness = std::get_if<std::shared_ptr<ReadinessCondition>>(&dependency.condition)) {
    return (*readiness)->describe();
  }
  const auto& condition = std::get<ProcessCondition>(dependency.condition);
  return std::visit(
      Overloaded{
          [&](const UntilStarted&) { return fmt::format("'{}' has started", condition.process); },
          [&](const UntilExited& until) {
            return fmt::format("'{}' has exited with exit code {}", condition.process, until.exit_code.text());
          },
          [&](const UntilOutput& until) {
            const std::string times = until.occurrence == 1 ? "" : fmt::format(", {} times", until.occurrence);
            return fmt::format("'{}' has written {}{}", condition.process, until.pattern.describe(), times);
          },
      },
      condition.state);
}

std::string_view to_string(OnFailure on_failure) {
  switch (on_failure) {
    case OnFailure::kShutdown:
      return "shutdown";
    case OnFailure::kStart:
      return "start";
    case OnFailure::kSkip:
      return "skip";
  }
  return "";
}

}  // namespace launch
