// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracing/model/analysis/derived_results.hpp"
#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"
#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

bool matches(const std::string& pattern, const std::string& name) {
  return pattern.empty() || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

// "*" behind a result that lost events may have changed, "~" behind an estimate.
std::string marked(const std::string& label, bool doubtful, bool estimated = false) {
  return label + (estimated ? " ~" : "") + (doubtful ? " *" : "");
}

// "/scan, /points": several chains may have one name.
std::string topics_of(const ChainResult& chain) {
  std::string text;
  for (const ChainResult::Step& step : chain.steps) {
    if (!step.topic.empty()) {
      text += (text.empty() ? "" : ", ") + step.topic;
    }
  }
  return text;
}

// What the steps of a chain have that tells it from others: one text for each step.
struct StepTexts {
  const char* before;
  std::string (*of)(const ChainResult::Step& step);
};
constexpr StepTexts kStepTexts[] = {
    {"through ", [](const ChainResult::Step& step) { return step.node; }},
    {"by ", [](const ChainResult::Step& step) { return step.topic; }},
    {"with ", [](const ChainResult::Step& step) { return step.callback; }},
};

std::vector<std::string> texts_of(const ChainResult& chain, const StepTexts& texts) {
  std::vector<std::string> list;
  for (const ChainResult::Step& step : chain.steps) {
    list.push_back(texts.of(step));
  }
  return list;
}

// "through /b, /c" of the chain /a -> 2 more -> /d, without what all chains of this label have. Empty for a single one.
std::string difference(const ChainResult& chain, const std::vector<const ChainResult*>& alike) {
  if (alike.size() < 2) {
    return "";
  }
  for (const StepTexts& texts : kStepTexts) {
    const std::vector<std::string> own = texts_of(chain, texts);
    std::vector<std::string> common = own;
    bool differs = true;
    for (const ChainResult* other : alike) {
      const std::vector<std::string> theirs = texts_of(*other, texts);
      differs = differs && (other == &chain || theirs != own);
      std::erase_if(common, [&theirs](const std::string& text) {
        return std::find(theirs.begin(), theirs.end(), text) == theirs.end();
      });
    }
    if (!differs) {
      continue;
    }
    std::string text;
    std::string whole;
    for (const std::string& step : own) {
      if (step.empty()) {
        continue;
      }
      whole += (whole.empty() ? texts.before : ", ") + step;
      if (std::find(common.begin(), common.end(), step) == common.end()) {
        text += (text.empty() ? texts.before : ", ") + step;
      }
    }
    return text.empty() ? whole : text;
  }
  return "";
}

}  // namespace

bool is_chosen(const ChainResult& chain, const ReportOptions& options) {
  const auto any = [&](const auto& fits) { return std::any_of(chain.steps.begin(), chain.steps.end(), fits); };
  if (!options.node.empty() && !any([&](const auto& step) { return matches(options.node, step.node); })) {
    return false;
  }
  if (!options.topic.empty() &&
      !any([&](const auto& step) { return !step.topic.empty() && matches(options.topic, step.topic); })) {
    return false;
  }
  if (options.chain.first.empty()) {
    return true;
  }
  const auto first = std::find_if(chain.steps.begin(), chain.steps.end(),
                                  [&](const auto& step) { return matches(options.chain.first, step.node); });
  return std::any_of(first, chain.steps.end(),
                     [&](const auto& step) { return matches(options.chain.second, step.node); });
}

std::string chain_table(const TraceResults& results, const ReportOptions& options) {
  const Ros2Results& ros2 = results.ros2;
  const Hosts hosts(results.overview);
  ResultTable<ChainResult> table("Chains", "");
  table.column("count", [](const ChainResult& chain) { return count_cell(chain.response.count); });
  table.times(&ChainResult::response, Style::kBold);
  if (std::any_of(ros2.chains.begin(), ros2.chains.end(),
                  [](const ChainResult& chain) { return chain.budget_ns.has_value(); })) {
    table.column("budget", [](const ChainResult& chain) {
      return chain.budget_ns ? Cell{format_duration(static_cast<double>(*chain.budget_ns))} : Cell{"-"};
    });
    table.count("over", &ChainResult::over_budget, Style::kBad);
  }
  table.time("reaction p99", &ChainResult::reaction, &DurationSummary::p99_ns);
  table.time("age max", &ChainResult::age, &DurationSummary::max_ns);
  std::map<std::string, std::vector<const ChainResult*>> alike;  // by label
  for (const ChainResult& chain : ros2.chains) {
    if (is_chosen(chain, options)) {
      alike[hosts.before(chain) + chain_label(chain)].push_back(&chain);
    }
  }
  for (const ChainResult& chain : ros2.chains) {
    if (!is_chosen(chain, options)) {
      continue;
    }
    const std::string label = hosts.before(chain) + chain_label(chain);
    Row row{.label = marked(label, chain.doubtful, chain.estimated)};
    row.below = difference(chain, alike[label]);
    row.remark = chain.name.empty() ? chain.steps.front().callback : topics_of(chain);
    sort_by(row, chain.response);
    table.add(std::move(row), chain);
  }
  return table.text(options);
}

std::string callback_table(const TraceResults& results, const ReportOptions& options) {
  const bool with_memory =
      std::any_of(results.ros2.callbacks.begin(), results.ros2.callbacks.end(),
                  [](const CallbackResult& callback) { return callback.allocations.value_or(0) > 0; });
  const Hosts hosts(results.overview);
  const double span =
      results.overview.begin_ns ? static_cast<double>(*results.overview.end_ns - *results.overview.begin_ns) : 0;
  ResultTable<CallbackResult> table("Callbacks", "total");
  table.column("rate", [](const CallbackResult& callback) { return rate_cell(callback.rate_hz); });
  table.column("count", [](const CallbackResult& callback) { return count_cell(callback.durations.count); });
  table.times(&CallbackResult::durations);
  if (with_memory) {
    table.column("mallocs",
                 [](const CallbackResult& callback) { return count_cell(callback.allocations.value_or(0)); });
  }
  table.time("jitter", &CallbackResult::jitter, &DurationSummary::p99_ns);
  table.count("missed", &CallbackResult::missed, Style::kWarning);
  table.column("load", [span](const CallbackResult& callback) {
    const DurationSummary& took = callback.durations;
    return span > 0 && took.count > 0 ? percent_cell(took.mean_ns * static_cast<double>(took.count) / span) : Cell{"-"};
  });
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (!matches(options.node, callback.node)) {
      continue;
    }
    const bool of_topic = callback.owner == CallbackResult::Owner::kSubscription;
    if (!options.topic.empty() && !(of_topic && matches(options.topic, callback.owner_name))) {
      continue;
    }
    Row row{.label = marked(hosts.before(callback.process) + callback_label(callback), callback.doubtful)};
    row.remark = short_symbol(callback.symbol);
    sort_by(row, callback.durations);
    row.rate = callback.rate_hz;
    table.add(std::move(row), callback);
  }
  return table.text(options);
}

std::string topic_table(const Ros2Results& ros2, const ReportOptions& options) {
  std::map<std::string, std::uint64_t> dropped;
  std::map<std::string, std::uint64_t> taken;      // by subscriptions: each message once, whichever way it comes
  std::map<std::string, DurationSummary> slowest;  // of the subscriptions
  for (const SubscriptionResult& subscription : ros2.subscriptions) {
    taken[subscription.topic] += subscription.received;
    dropped[subscription.topic] += subscription.dropped();
    DurationSummary& known = slowest[subscription.topic];
    if (known.count == 0 || subscription.latency.p99_ns > known.p99_ns) {
      known = subscription.latency;
    }
  }
  struct Traffic {
    double rate_hz;
    std::uint64_t sent;
    std::uint64_t received;
    std::uint64_t dropped;
    DurationSummary latency;
  };
  ResultTable<Traffic> table("Topics", "p99");
  table.column("rate", [](const Traffic& traffic) { return rate_cell(traffic.rate_hz); });
  table.count("sent", &Traffic::sent);
  table.count("received", &Traffic::received);
  table.count("dropped", &Traffic::dropped, Style::kBad);
  table.times(&Traffic::latency);
  for (const TopicResult& topic : ros2.topics) {
    const std::uint64_t sent = std::max(topic.published, topic.intra_process_published);
    const auto known = taken.find(topic.name);
    const std::uint64_t received = known == taken.end() ? topic.received : known->second;
    if (!matches(options.topic, topic.name)) {
      continue;
    }
    if (!options.node.empty() &&
        std::none_of(ros2.subscriptions.begin(), ros2.subscriptions.end(), [&](const SubscriptionResult& subscription) {
          return subscription.topic == topic.name && matches(options.node, subscription.node);
        })) {
      continue;
    }
    const DurationSummary latency = slowest[topic.name].count > 0 ? slowest[topic.name] : topic.latency;
    Row row{.label = marked(topic.name, topic.doubtful, topic.is_estimated())};
    sort_by(row, latency);
    row.rate = topic.rate_hz;
    row.count = static_cast<double>(sent);
    table.add(std::move(row), {topic.rate_hz, sent, received, dropped[topic.name], latency});
  }
  return table.text(options);
}

std::string executor_table(const TraceResults& results, const ReportOptions& options) {
  if (!options.node.empty() || !options.topic.empty()) {
    return "";
  }
  ResultTable<ExecutorResult> table("Executors", "total");
  table.column("busy", [](const ExecutorResult& executor) {
    // Of a thread that ran one callback, and told of no wait, nothing else is known.
    return executor.callbacks > 1 || executor.waited_ns ? percent_cell(executor.utilisation) : Cell{"-"};
  });
  table.count("callbacks", &ExecutorResult::callbacks);
  table.column("longest busy", [](const ExecutorResult& executor) {
    return executor.longest_busy_ns > 0 ? Cell{format_duration(static_cast<double>(executor.longest_busy_ns))}
                                        : Cell{"-"};
  });
  table.column("in", [](const ExecutorResult& executor) { return Cell{shortened(executor.longest_callback, 40)}; });
  const Hosts hosts(results.overview);
  for (const ExecutorResult& executor : results.ros2.executors) {
    if (executor.callbacks == 0) {
      continue;
    }
    Row row{.label = marked(hosts.before(executor.process) + executor_label(executor, results), executor.doubtful)};
    row.total = executor.utilisation;
    row.count = static_cast<double>(executor.callbacks);
    row.max = static_cast<double>(executor.longest_busy_ns);
    table.add(std::move(row), executor);
  }
  return table.text(options);
}

std::string service_table(const TraceResults& results, const ReportOptions& options) {
  if (!options.topic.empty()) {
    return "";
  }
  const Hosts hosts(results.overview);
  ResultTable<CallResult> table("Services", "p99");
  table.count("calls", &CallResult::requests);
  table.column("unanswered", [](const CallResult& call) { return count_cell(call.unanswered(), Style::kBad); });
  table.times(&CallResult::round_trip);
  for (const CallResult& call : results.ros2.calls) {
    if (is_of_action(call.service)) {
      continue;
    }
    if (!matches(options.node, call.client) && !matches(options.node, call.server)) {
      continue;
    }
    Row row{.label = fmt::format("{}, asked by {}{}", call.service, hosts.before(call.client_process),
                                 call.client.empty() ? "?" : call.client)};
    sort_by(row, call.round_trip);
    row.count = static_cast<double>(call.requests);
    table.add(std::move(row), call);
  }
  return table.text(options);
}

std::string action_table(const TraceResults& results, const ReportOptions& options) {
  if (!options.topic.empty()) {
    return "";
  }
  const Hosts hosts(results.overview);
  ResultTable<ActionResult> table("Actions", "p99");
  table.count("goals", &ActionResult::goals);
  table.count("results", &ActionResult::results);
  table.count("cancels", &ActionResult::cancels, Style::kWarning);
  table.count("feedback", &ActionResult::feedback);
  table.times(&ActionResult::execution);
  for (const ActionResult& action : results.ros2.actions) {
    if (!matches(options.node, action.client) && !matches(options.node, action.server)) {
      continue;
    }
    Row row{.label = fmt::format("{}, asked by {}{}", action.name, hosts.before(action.client_process),
                                 action.client.empty() ? "?" : action.client)};
    sort_by(row, action.execution);
    row.count = static_cast<double>(action.goals);
    table.add(std::move(row), action);
  }
  return table.text(options);
}

std::string lifecycle_table(const TraceResults& results, const ReportOptions& options) {
  if (!options.topic.empty()) {
    return "";
  }
  const Ros2Results& ros2 = results.ros2;
  const Hosts hosts(results.overview);
  const bool with_memory = std::any_of(ros2.lifecycle.begin(), ros2.lifecycle.end(),
                                       [](const LifecycleResult& result) { return result.process_allocations > 0; });
  struct Node {
    std::string state;
    std::int64_t active_ns = 0;
    std::uint64_t changes = 0;
    std::uint64_t allocations = 0;
  };
  ResultTable<Node> table("Lifecycle nodes", "name");
  table.column("state at the end", [](const Node& node) { return Cell{node.state}; });
  table.column("time in active",
               [](const Node& node) { return Cell{format_duration(static_cast<double>(node.active_ns))}; });
  table.count("changes", &Node::changes);
  if (with_memory) {
    table.count("mallocs in active", &Node::allocations, Style::kWarning);
  }
  std::map<std::pair<std::string, ProcessIndex>, Node> nodes;
  for (const LifecycleResult& result : ros2.lifecycle) {
    if (!matches(options.node, result.node)) {
      continue;
    }
    Node& node = nodes[{result.node.empty() ? "?" : result.node, result.process}];
    node.state = result.state;
    if (result.state == "active") {
      node.active_ns += result.end_ns - result.begin_ns;
      node.allocations += result.allocations.value_or(0);
    }
    if (result.ended) {
      ++node.changes;
    }
  }
  for (const auto& [name, node] : nodes) {
    table.add({.label = hosts.before(name.second) + name.first}, node);
  }
  return table.text(options);
}

}  // namespace tracing
