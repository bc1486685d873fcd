// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/summary/summary.hpp"

namespace tracing {

std::vector<NodeResult> node_results(const Subjects& subjects, const std::vector<CallbackResult>& callbacks) {
  std::map<std::pair<ProcessIndex, std::string>, NodeResult> nodes;
  const auto node = [&nodes](ProcessIndex process, const std::string& name) -> NodeResult& {
    NodeResult& result = nodes[{process, name}];
    result.process = process;
    result.name = name;
    return result;
  };
  for (const NodeObject& object : subjects.model().nodes()) {
    node(subjects.place_of(object.process), object.name);
  }
  for (const CallbackResult& callback : callbacks) {
    if (callback.node.empty()) {
      continue;
    }
    NodeResult& result = node(callback.process, callback.node);
    result.callbacks += callback.durations.count;
    result.callback_ns += std::llround(callback.durations.mean_ns * static_cast<double>(callback.durations.count));
  }
  std::vector<NodeResult> results;
  for (auto& [key, result] : nodes) {
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<LifecycleResult> lifecycle_results(const Subjects& subjects, const LifecycleTracker& lifecycle,
                                               const AllocationCounter& allocations) {
  const ObjectModel& model = subjects.model();
  std::vector<LifecycleResult> results;
  for (const LifecycleRecord& record : lifecycle.records()) {
    LifecycleResult result{
        subjects.place_of(record.process), "", record.state, record.begin_ns, record.end_ns, record.ended};
    if (record.node != kNoObject) {
      result.node = model.nodes()[record.node].name;
    }
    if (allocations.has_allocations()) {
      result.allocations = record.of_callbacks.calls;
      result.allocated_bytes = record.of_callbacks.bytes;
      result.process_allocations = record.of_process.calls;
      result.process_allocated_bytes = record.of_process.bytes;
    }
    results.push_back(std::move(result));
  }
  std::stable_sort(results.begin(), results.end(), [](const LifecycleResult& a, const LifecycleResult& b) {
    return std::tie(a.node, a.process, a.begin_ns) < std::tie(b.node, b.process, b.begin_ns);
  });
  return results;
}

}  // namespace tracing
