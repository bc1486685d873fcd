// The state that actions are visited in, and what they ask for.
//
// Visiting changes nothing outside: an action reads and changes the scope and leaves requests. Whoever drives the visit
// takes the requests afterwards and carries them out (launch_service.hpp) or prints them (launch_plan.hpp), so that an
// error in the middle of a file has started nothing.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "launcher/core/action.hpp"
#include "launcher/core/launch_description.hpp"
#include "launcher/core/registry.hpp"
#include "launcher/core/run_scope.hpp"
#include "launcher/process/output_router.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct TimerRequest {
  Duration period{0};
  bool cancel_on_shutdown = true;
  std::vector<ActionPtr> actions;
  Scope scope;  // as it was where the timer stands
};

struct ShutdownRequest {
  std::string reason;
};

// What one traversal asked for. Scopes begin before its processes start.
struct Requests {
  std::vector<std::unique_ptr<RunScope>> scopes;
  std::vector<ProcessSpec> processes;
  std::vector<TimerRequest> timers;
  std::optional<ShutdownRequest> shutdown;
};

class LaunchContext {
 public:
  // Receives the messages of `log` actions and warnings of the visit.
  using MessageSink = std::function<void(LogLevel level, std::string_view logger, std::string_view text)>;

  // `own_prefix` is the install prefix of this launcher (package_index.hpp). The registry must outlive the context.
  LaunchContext(const Registry& registry, Environment environment, std::string own_prefix, MessageSink messages);

  Scope& scope() { return scope_; }
  const Registry& registry() const { return registry_; }
  // The environment that the launcher was started with.
  const Environment& initial_environment() const { return initial_environment_; }
  const std::string& own_prefix() const { return own_prefix_; }

  // Visits actions in order, in the current scope. Throws LaunchError.
  void visit(const std::vector<ActionPtr>& actions);
  // Visits a whole file: $(dirname) and $(filename) mean it until it ends. `before` runs once they do.
  void visit(const LaunchDescription& description, const std::function<void()>& before = {});
  // Visits actions in a scope of their own, which ends with them.
  void visit_in(Scope scope, const std::vector<ActionPtr>& actions);

  Requests& requests() { return requests_; }
  Requests take_requests();

  void message(LogLevel level, std::string_view logger, std::string_view text) { messages_(level, logger, text); }

  // Counts a node by its fully qualified name and warns when there are several.
  void note_node(const std::string& fully_qualified_name);

 private:
  const Registry& registry_;
  Environment initial_environment_;
  std::string own_prefix_;
  MessageSink messages_;
  Scope scope_;
  Requests requests_;
  std::unordered_map<std::string, int> nodes_;
};

}  // namespace launch
