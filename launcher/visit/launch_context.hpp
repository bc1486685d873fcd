// SPDX-License-Identifier: Apache-2.0
// The state in which actions are visited, and their requests.
//
// Visiting changes nothing outside: an action reads and changes the scope and leaves requests. The code that drives the
// visit takes the requests afterwards and carries them out (launch_service.hpp) or prints them (launch_plan.hpp). An
// error in the middle of a file has therefore started nothing.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "launcher/language/action.hpp"
#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/exploration.hpp"
#include "launcher/visit/machines.hpp"
#include "launcher/visit/requests.hpp"
#include "launcher/visit/test_visits.hpp"

namespace launch {

class RosClient;

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
  // That of the machine of the scope, before a launch file changes it.
  const Environment& initial_environment_there() const {
    return scope_.machine == nullptr ? initial_environment_ : scope_.machine->environment();
  }
  const std::string& own_prefix() const { return own_prefix_; }

  // What the command line asks of the whole launch. It is not in the environment, because processes and the launches
  // within them inherit that.
  struct Wishes {
    std::string process_output;  // of every process, by `launch -a`; empty: what the launch file says
    bool report = false;         // a page of each trace that does not say otherwise, by `launch --report`
  };
  void set_wishes(Wishes wishes) { wishes_ = std::move(wishes); }
  const Wishes& wishes() const { return wishes_; }

  // Levels for the loggers of nodes, by `launch --log-level`; the node is a name or a shell pattern.
  struct NodeLogLevel {
    std::string node;  // empty: every node
    std::string level;
  };
  void set_log_levels(std::vector<NodeLogLevel> levels) { log_levels_ = std::move(levels); }
  const std::vector<NodeLogLevel>& log_levels() const { return log_levels_; }

  // From now on no request will be carried out.
  void plan_only() {
    plan_only_ = true;
    machines_.plan_only();
  }
  bool is_plan_only() const { return plan_only_; }

  // Which tests the visit requests.
  TestVisits& tests() { return tests_; }
  // Whether the visit goes on after errors, and whom it tells of them.
  Exploration& exploration() { return exploration_; }

  // Those that launch files have declared.
  Machines& machines() { return machines_; }

  // The client that answers requests of actions to the ROS graph. It must outlive the context. Null while nothing is
  // carried out.
  void use_ros_client(RosClient& client) { ros_client_ = &client; }
  RosClient* ros_client() const { return ros_client_; }

  // Executes the action if its condition holds. Throws LaunchError.
  void visit(const Action& action);
  // Visits actions in order, in the current scope. Throws LaunchError.
  void visit(const std::vector<ActionPtr>& actions);
  // Visits a whole file: $(dirname) and $(filename) mean this file until the visit ends. `before` is called when they
  // do.
  void visit(const LaunchDescription& description, const std::function<void()>& before = {});
  // Visits actions in a scope of their own, which ends with them.
  void visit_in(Scope scope, const std::vector<ActionPtr>& actions);

  // Visits the actions of a handler whose event has happened; `planned` if it only might happen.
  void visit(const Invocation& invocation, bool planned = false);

  // What a visit has changed.
  struct State {
    Scope scope;
    Requests requests;
    std::unordered_map<std::string, int> nodes;
    std::vector<Scope> pushed_environments;
    std::vector<Scope> pushed_configurations;
    MessageSink messages;
    std::vector<MachineAssignment> assignments;
  };
  // begin_again() comes back to what is now.
  void keep_beginning() { beginning_ = scope_; }
  // Prepares another visit of the whole launch, whose messages go to the sink. Returns what was. The names of $(anon)
  // stay, and packages are searched for anew. keep_beginning() must have been called.
  State begin_again(MessageSink messages);
  // Throws a visit away.
  void put_back(State state);
  void put_back(MessageSink messages) { messages_ = std::move(messages); }

  // The launch files that were visited, by their paths.
  const std::set<std::string>& files() const { return files_; }

  Requests& requests() { return requests_; }
  Requests take_requests();

  void message(LogLevel level, std::string_view logger, std::string_view text) { messages_(level, logger, text); }

  // The scopes that PushEnvironment or PushLaunchConfigurations of a Python launch file have kept, the last one at the
  // end.
  std::vector<Scope>& kept_scopes(bool environment) {
    return environment ? pushed_environments_ : pushed_configurations_;
  }

  // Counts a node by its fully qualified name and warns when there are several.
  void note_node(const std::string& fully_qualified_name);

 private:
  // Executes an action that its condition leaves out, if the visit explores.
  void visit_left_out(const Action& action);

  const Registry& registry_;
  Environment initial_environment_;
  std::string own_prefix_;
  MessageSink messages_;
  Scope scope_;
  Requests requests_;
  Wishes wishes_;
  std::vector<NodeLogLevel> log_levels_;
  bool plan_only_ = false;
  TestVisits tests_;
  Exploration exploration_{scope_};
  int depth_ = 0;  // of the actions that are being visited
  std::vector<Scope> pushed_environments_;
  std::vector<Scope> pushed_configurations_;
  RosClient* ros_client_ = nullptr;
  std::unordered_map<std::string, int> nodes_;
  std::optional<Scope> beginning_;
  std::set<std::string> files_;
  Machines machines_;
};

}  // namespace launch
