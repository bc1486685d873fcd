#include "launcher/core/launch_plan.hpp"

#include <iterator>
#include <map>

namespace launch {

namespace {

template <typename Item>
void append(std::vector<Item>& to, std::vector<Item>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

void collect(LaunchPlan& plan, Requests requests, std::multimap<Duration, TimerRequest>& timers, Duration now) {
  append(plan.scopes, requests.scopes);
  for (NodeDescription& node : requests.nodes) {
    node.process += plan.processes.size();
    plan.nodes.push_back(std::move(node));
  }
  append(plan.loads, requests.loads);
  append(plan.transitions, requests.transitions);
  append(plan.logs, requests.logs);
  append(plan.python_includes, requests.python_includes);
  plan.includes += requests.includes;
  for (ProcessSpec& spec : requests.processes) {
    for (const auto& scope : plan.scopes) {
      scope->prepare(spec);
    }
    plan.processes.push_back(std::move(spec));
  }
  for (TimerRequest& timer : requests.timers) {
    timers.emplace(now + timer.period, std::move(timer));
  }
  plan.shutdown |= requests.shutdown.has_value();
}

}  // namespace

LaunchPlan plan_launch(LaunchContext& context, const LaunchDescription& description) {
  LaunchPlan plan;
  std::multimap<Duration, TimerRequest> timers;
  context.plan_only();
  context.visit(description);
  collect(plan, context.take_requests(), timers, Duration(0));
  while (!timers.empty() && !plan.shutdown) {
    auto next = timers.extract(timers.begin());
    context.visit_in(std::move(next.mapped().scope), next.mapped().actions);
    collect(plan, context.take_requests(), timers, next.key());
  }
  return plan;
}

}  // namespace launch
