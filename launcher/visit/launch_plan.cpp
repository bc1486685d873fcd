// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/launch_plan.hpp"

#include <iterator>
#include <map>

#include "launcher/visit/dependency_resolution.hpp"
#include "launcher/visit/farewell_check.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

namespace {

template <typename Item>
void append(std::vector<Item>& to, std::vector<Item>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// An event such as could have happened.
EventValues made_up_event(const EventHandler& handler) {
  EventValues values = {{"process", handler.process.empty() ? "process-1" : handler.process + "-1"}, {"pid", "0"}};
  if (const auto* const exit = std::get_if<OnProcessExit>(&handler.event)) {
    values.emplace_back("exit_code", std::to_string(exit->exit_code.example()));
  } else if (const auto* const io = std::get_if<OnProcessIo>(&handler.event)) {
    values.emplace_back("text", "");
    values.emplace_back("stream", io->pattern.stream() == "stderr" ? "stderr" : "stdout");
  } else if (std::holds_alternative<OnShutdown>(handler.event)) {
    values = {{"reason", ""}};
  } else if (const auto* const transition = std::get_if<OnStateTransition>(&handler.event)) {
    values = {
        {"node", transition->node}, {"start_state", transition->start_state}, {"goal_state", transition->goal_state}};
  } else if (std::holds_alternative<OnceReady>(handler.event)) {
    values.clear();
  }
  return values;
}

class Planner {
 public:
  explicit Planner(LaunchContext& context) : context_(context) {}

  // The requests since the last call, with everything that follows from them.
  LaunchPlan plan_requests() {
    LaunchPlan plan;
    std::multimap<Duration, TimerRequest> timers;
    collect(plan, timers, Duration(0));
    while (!timers.empty() && !plan.shutdown) {
      auto next = timers.extract(timers.begin());
      next.mapped().scope.only_planned = true;
      next.mapped().scope.planned_by_timer = true;
      context_.visit_in(std::move(next.mapped().scope), next.mapped().actions);
      collect(plan, timers, next.key());
    }
    for (PlannedHandler& planned : plan.handlers) {
      const auto handler = std::make_shared<const EventHandler>(planned.handler);
      context_.visit(Invocation{handler, made_up_event(*handler)}, true);
      if (std::holds_alternative<OnShutdown>(handler->event)) {
        or_report([&] { check_farewell(context_.requests(), handler->live); });
      }
      planned.plan = plan_requests();
    }
    scopes_.resize(scopes_.size() - plan.scopes.size());
    return plan;
  }

 private:
  // A visit that explores goes on after an error.
  template <typename Step>
  void or_report(Step step) {
    try {
      step();
    } catch (const LaunchError& error) {
      if (!context_.explores()) {
        throw;
      }
      context_.report(error);
    }
  }

  void collect(LaunchPlan& plan, std::multimap<Duration, TimerRequest>& timers, Duration now) {
    Requests requests = context_.take_requests();
    for (const auto& scope : requests.scopes) {
      scope->expect(requests.processes);
      scopes_.push_back(scope.get());
    }
    append(plan.scopes, requests.scopes);

    std::vector<TrackedProcess*> asked_for;
    for (const ProcessSpec& spec : requests.processes) {
      asked_for.push_back(&table_.add(spec));
    }
    append(plan.left_to_run, requests.left_to_run);
    any_left_ |= !plan.left_to_run.empty();
    try {
      resolve_dependencies(requests.dependencies, asked_for, table_);
      for (TestRequest& test : requests.tests) {
        for (FaultRequest& fault : test.faults) {
          resolve_targets(fault.dependencies, asked_for, table_);
        }
      }
      check_commands(requests.commands, table_);
    } catch (const LaunchError& error) {
      if (any_left_) {
        // A function that was not called may start the process that this speaks of.
        const Diagnostic& first = error.diagnostics().front();
        plan.left_to_run.push_back({"", first.message, first.where});
      } else if (context_.explores()) {
        context_.report(error);
      } else {
        throw;
      }
    }

    for (NodeDescription& node : requests.nodes) {
      node.process += plan.processes.size();
      plan.nodes.push_back(std::move(node));
    }
    for (Dependency& dependency : requests.dependencies) {
      dependency.process += plan.processes.size();
      plan.dependencies.push_back(std::move(dependency));
    }
    for (EventHandler& handler : requests.handlers) {
      plan.handlers.push_back({std::move(handler), {}});
    }
    append(plan.commands, requests.commands);
    append(plan.loads, requests.loads);
    append(plan.transitions, requests.transitions);
    append(plan.coroutines, requests.coroutines);
    append(plan.tests, requests.tests);
    append(plan.logs, requests.logs);
    append(plan.python_includes, requests.python_includes);
    plan.includes += requests.includes;
    for (ProcessSpec& spec : requests.processes) {
      for (const RunScope* const scope : scopes_) {
        scope->prepare(spec);
      }
      plan.processes.push_back(std::move(spec));
      plan.delays.push_back(now);
    }
    for (TimerRequest& timer : requests.timers) {
      timers.emplace(now + timer.period, std::move(timer));
    }
    plan.shutdown |= requests.shutdown.has_value();
  }

  LaunchContext& context_;
  ProcessTable table_;
  bool any_left_ = false;                // a function was left to a run
  std::vector<const RunScope*> scopes_;  // scopes that are active at this point
};

}  // namespace

LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description) {
  context.plan_only();
  context.visit(description);
  return Planner(context).plan_requests();
}

}  // namespace launch
