// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/launch_plan.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "base/overloaded.hpp"
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
  } else if (const auto* const change = std::get_if<OnHealthChange>(&handler.event)) {
    values.emplace_back("health", name_of(change->health.value_or(Health::kUnhealthy)));
    values.emplace_back("reason", "");
  } else if (std::holds_alternative<OnStartLimit>(handler.event)) {
    values.emplace_back("starts", "1");
  } else if (const auto* const lost = std::get_if<OnMachineLost>(&handler.event)) {
    values = {{"machine", lost->machine.empty() ? "machine" : lost->machine}, {"reason", ""}, {"processes", ""}};
  } else if (const auto* const back = std::get_if<OnMachineBack>(&handler.event)) {
    values = {{"machine", back->machine.empty() ? "machine" : back->machine}, {"for", "1.0"}, {"dropped", "0"}};
  } else if (std::holds_alternative<OnShutdown>(handler.event)) {
    values = {{"reason", ""}};
  } else if (const auto* const transition = std::get_if<OnStateTransition>(&handler.event)) {
    values = {
        {"node", transition->node}, {"start_state", transition->start_state}, {"goal_state", transition->goal_state}};
  } else if (const auto* const condition = std::get_if<OnCondition>(&handler.event)) {
    values = values_of(*condition, {.holds = true, .processes = {"process-1"}});
  } else if (std::holds_alternative<OnceReady>(handler.event)) {
    values.clear();
  }
  return values;
}

bool has_trace(const std::vector<const RunScope*>& scopes) {
  return std::any_of(scopes.begin(), scopes.end(), [](const RunScope* scope) { return scope->kind() == "trace"; });
}

class Planner {
 public:
  Planner(LaunchContext& context, PlannedScopes prepares) : context_(context), prepares_(prepares) {}

  // The requests since the last call, with everything that follows from them.
  LaunchPlan plan_requests() {
    LaunchPlan plan;
    std::multimap<Duration, TimerRequest> timers;
    collect(plan, timers, Duration(0));
    while (!timers.empty() && plan.shutdowns.empty()) {
      auto next = timers.extract(timers.begin());
      next.mapped().scope.only_planned = true;
      next.mapped().scope.planned_by_timer = true;
      context_.visit_in(std::move(next.mapped().scope), next.mapped().actions);
      collect(plan, timers, next.key());
    }
    for (const EventHandler& planned : plan.handlers) {
      const auto handler = std::make_shared<const EventHandler>(planned);
      context_.visit(Invocation{handler, made_up_event(*handler)}, true);
      if (std::holds_alternative<OnShutdown>(handler->event)) {
        or_report([&] { check_farewell(context_.requests(), handler->live); });
      }
      plan.reactions.push_back(plan_requests());
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
      if (!context_.exploration().is_on()) {
        throw;
      }
      context_.exploration().report(error);
    }
  }

  void collect(LaunchPlan& plan, std::multimap<Duration, TimerRequest>& timers, Duration now) {
    Requests requests = context_.take_requests();
    for (const auto& scope : requests.scopes) {
      if (prepares_ == PlannedScopes::kCarriedOut) {
        scope->expect(requests.processes);
      }
      scopes_.push_back(scope.get());
    }
    append(plan.left_to_run, requests.left_to_run);
    any_left_ |= !plan.left_to_run.empty();
    resolve_names(plan, requests);

    const std::size_t first = plan.processes.size();
    for_each_request(requests,
                     Overloaded{
                         [&](RunScopePtr& scope) { plan.scopes.push_back(std::move(scope)); },
                         [&](ProcessCommand& command) { plan.commands.push_back(std::move(command)); },
                         [&](UnregisterRequest& request) { plan.unregistered.push_back(std::move(request)); },
                         [&](TestRequest& test) { plan.tests.push_back(std::move(test)); },
                         [&](EventHandler& handler) { plan.handlers.push_back(std::move(handler)); },
                         [&](TimerRequest& timer) { timers.emplace(now + timer.period, std::move(timer)); },
                         [&](LoadRequest& load) { plan.loads.push_back(std::move(load)); },
                         [&](TransitionRequest& transition) { plan.transitions.push_back(std::move(transition)); },
                         [&](ProcessSpec& spec) {
                           prepare(spec);
                           plan.processes.push_back(std::move(spec));
                           plan.delays.push_back(now);
                         },
                         [&](CoroutineRequest& coroutine) { plan.coroutines.push_back(std::move(coroutine)); },
                         [&](ShutdownRequest& shutdown) { plan.shutdowns.push_back(std::move(shutdown)); },
                         [&](NodeDescription& node) {
                           node.process += first;
                           plan.nodes.push_back(std::move(node));
                         },
                         [&](Dependency& dependency) {
                           dependency.process += first;
                           plan.dependencies.push_back(std::move(dependency));
                         },
                     });
    append(plan.logs, requests.logs);
    append(plan.python_includes, requests.python_includes);
    plan.includes += requests.includes;
  }

  void prepare(ProcessSpec& spec) const {
    if (prepares_ == PlannedScopes::kCarriedOut) {
      std::for_each(scopes_.begin(), scopes_.end(), [&](const RunScope* scope) { scope->prepare(spec); });
    }
  }

  // Finds the processes that the requests name.
  void resolve_names(LaunchPlan& plan, Requests& requests) {
    std::vector<TrackedProcess*> asked_for;
    for (const ProcessSpec& spec : requests.processes) {
      asked_for.push_back(&table_.add(spec));
    }
    try {
      resolve_dependencies(requests.dependencies, asked_for, table_);
      for (TestRequest& test : requests.tests) {
        for (FaultRequest& fault : test.faults) {
          resolve_targets(fault.dependencies, asked_for, table_);
        }
      }
      check_commands(requests.commands, table_);
      check_conditions(requests.handlers, has_trace(scopes_));
    } catch (const LaunchError& error) {
      if (any_left_) {
        // A function that was not called may start the process that this speaks of, or a trace.
        const Diagnostic& first = error.diagnostics().front();
        plan.left_to_run.push_back({"", first.message, first.where});
      } else if (context_.exploration().is_on()) {
        context_.exploration().report(error);
      } else {
        throw;
      }
    }
  }

  LaunchContext& context_;
  PlannedScopes prepares_;
  ProcessTable table_;
  bool any_left_ = false;                // a function was left to a run
  std::vector<const RunScope*> scopes_;  // scopes that are active at this point
};

}  // namespace

LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description, PlannedScopes scopes) {
  context.plan_only();
  context.visit(description);
  return Planner(context, scopes).plan_requests();
}

}  // namespace launch
