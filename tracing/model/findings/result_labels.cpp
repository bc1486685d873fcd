// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/findings/result_labels.hpp"

#include <fmt/format.h>

#include <set>

#include "tracing/model/objects/object_names.hpp"

namespace tracing {

std::string source_label(const CallbackResult& callback) {
  switch (callback.owner) {
    case CallbackResult::Owner::kSubscription:
      return "subscription " + callback.owner_name;
    case CallbackResult::Owner::kService:
      return "service " + callback.owner_name;
    case CallbackResult::Owner::kClient:
      return callback.owner_name.empty() ? fmt::format("client {:#x}", callback.address)
                                         : "client of " + callback.owner_name;
    case CallbackResult::Owner::kTimer:
      return "timer " + period_text(callback.period_ns);
    case CallbackResult::Owner::kUnknown:
      break;
  }
  return fmt::format("callback {:#x}", callback.address);
}

std::string callback_label(const CallbackResult& callback) {
  const std::string source = source_label(callback);
  return callback.node.empty() ? source : fmt::format("{}, {}", callback.node, source);
}

std::string process_label(const ProcessResult& process) {
  const std::string name = process.name.empty() ? "process" : process.name;
  return process.vpid ? fmt::format("{} [{}]", name, *process.vpid) : fmt::format("{} [?]", name);
}

std::string chain_label(const ChainResult& chain) {
  const auto name = [&chain](std::size_t step) {
    return chain.steps[step].node.empty() ? std::string("?") : chain.steps[step].node;
  };
  const std::size_t steps = chain.steps.size();
  constexpr std::size_t kShown = 3;
  std::string text = chain.name.empty() ? "" : chain.name + ": ";
  if (steps > kShown) {
    return text + fmt::format("{} -> {} more -> {}", name(0), steps - 2, name(steps - 1));
  }
  for (std::size_t step = 0; step < steps; ++step) {
    text += (step == 0 ? "" : " -> ") + name(step);
  }
  return text;
}

std::string executor_label(const ExecutorResult& executor, const TraceResults& results) {
  if (executor.process >= results.overview.processes.size()) {
    return fmt::format("thread {}", executor.vtid);
  }
  const ProcessResult& process = results.overview.processes[executor.process];
  std::set<std::string> nodes;
  for (const CallbackResult& callback : results.ros2.callbacks) {
    if (callback.process == executor.process && !callback.node.empty()) {
      nodes.insert(callback.node);
    }
  }
  std::string label = process_label(process);
  if (nodes.size() == 1 && process.vpid) {
    label = fmt::format("{} [{}]", *nodes.begin(), *process.vpid);
  }
  return process.vpid == executor.vtid ? label : fmt::format("{}, thread {}", label, executor.vtid);
}

}  // namespace tracing
