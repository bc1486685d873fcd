// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/summary/summary.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

namespace {

ExecutionResult execution_result(const Subjects& subjects, const Served& served, const ExecutionRecord& record) {
  const ObjectModel& model = subjects.model();
  using Kind = ros2::ExecutionEvent::Kind;
  ExecutionResult result;
  result.process = subjects.place_of(served.process);
  result.address = served.address;
  result.count = record.count;
  result.durations = record.durations.summary();
  ObjectId node = kNoObject;
  if (served.kind == Kind::kService) {
    if (served.id != kNoObject) {
      node = model.services()[served.id].node;
      result.service = model.services()[served.id].name;
    }
  } else if (served.kind == Kind::kClient) {
    result.kind = ExecutionResult::Kind::kClient;
    if (served.id != kNoObject) {
      node = model.clients()[served.id].node;
      result.service = model.clients()[served.id].name;
    }
  } else {
    result.kind = ExecutionResult::Kind::kWaitable;
  }
  if (node != kNoObject) {
    result.node = model.nodes()[node].name;
  }
  return result;
}

}  // namespace

std::vector<ExecutionResult> execution_results(const Subjects& subjects, const ExecutionTracker& executions) {
  std::vector<ExecutionResult> results;
  for (const auto& [served, record] : executions.records()) {
    results.push_back(execution_result(subjects, served, record));
  }
  return results;
}

std::vector<ExecutorResult> executor_results(const Subjects& subjects, const ExecutorLoad& executors) {
  const ObjectModel& model = subjects.model();
  std::vector<ExecutorResult> results;
  for (const auto& [thread, record] : executors.records()) {
    ExecutorResult result;
    result.process = subjects.place_of(thread.process);
    result.vtid = thread.vtid;
    result.span_ns = record.last_ns - record.first_ns;
    result.callbacks = record.callbacks;
    result.callback_ns = record.callback_ns;
    std::int64_t busy = record.callback_ns;
    if (record.waits > 0) {
      result.waited_ns = record.waited_ns;
      busy = result.span_ns - record.waited_ns;
    }
    if (result.span_ns > 0) {
      result.utilisation = static_cast<double>(busy) / static_cast<double>(result.span_ns);
    }
    result.longest_busy_ns = record.longest_busy_ns;
    result.longest_busy_begin_ns = record.longest_busy_begin_ns;
    if (record.longest_callback != kNoObject) {
      const CallbackObject& callback = model.callbacks()[record.longest_callback];
      const std::string node = node_name(model, callback);
      result.longest_callback = (node.empty() ? "" : node + ", ") + callback_source(model, callback);
    }
    result.doubtful = subjects.is_doubtful(result.process);
    results.push_back(std::move(result));
  }
  std::sort(results.begin(), results.end(), [](const ExecutorResult& a, const ExecutorResult& b) {
    return std::tie(a.process, a.vtid) < std::tie(b.process, b.vtid);
  });
  return results;
}

}  // namespace tracing
