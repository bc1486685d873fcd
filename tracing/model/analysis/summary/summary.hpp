// SPDX-License-Identifier: Apache-2.0
// Makes the results of each subject from what the parts of the analysis have counted and measured. To be called at the
// end of the trace, when these parts are finished.
//
// A file of this folder has the functions of one subject.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tracing/model/analysis/join/event_join.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/allocation_counter.hpp"
#include "tracing/model/execution/callback_timing.hpp"
#include "tracing/model/execution/executor_load.hpp"
#include "tracing/model/execution/hold_ups.hpp"
#include "tracing/model/messages/chain_tracker.hpp"
#include "tracing/model/messages/delivery_statistics.hpp"

namespace tracing {

// Whom results tell of: objects, and the processes that they belong to.
class Subjects {
 public:
  // `places`: where each process is in `processes`. Empty lists leave it where it is. `model` and `processes` must
  // outlive this object. `end_ns`: when the trace ends; 0: unknown.
  Subjects(const ObjectModel& model, std::vector<std::optional<ProcessIndex>> places,
           const std::vector<ProcessResult>& processes, std::int64_t end_ns = 0)
      : model_(model), places_(std::move(places)), processes_(processes), end_ns_(end_ns) {}

  const ObjectModel& model() const { return model_; }
  ProcessIndex place_of(ProcessId process) const {
    return process < places_.size() ? places_[process].value_or(process) : process;
  }
  // Whether events may be missing.
  bool is_doubtful(ProcessIndex process) const { return process < processes_.size() && processes_[process].doubtful; }
  // In a second, from the first to the last one. 0 for a burst: the time between them is less than a tenth of that from
  // the first one to the end of the trace.
  double rate(std::uint64_t count, std::int64_t first_ns, std::int64_t last_ns) const {
    constexpr std::int64_t kBurst = 10;
    if (count < 2 || last_ns <= first_ns || (last_ns - first_ns) * kBurst < end_ns_ - first_ns) {
      return 0;
    }
    return static_cast<double>(count - 1) * 1e9 / static_cast<double>(last_ns - first_ns);
  }

 private:
  const ObjectModel& model_;
  std::vector<std::optional<ProcessIndex>> places_;
  const std::vector<ProcessResult>& processes_;
  std::int64_t end_ns_;
};

std::vector<CallbackResult> callback_results(const Subjects& subjects, const CallbackTracker& callbacks,
                                             const CallbackTiming& timing, const HoldUps& hold_ups);

std::vector<TopicResult> topic_results(const Subjects& subjects, const MessageMatcher& messages,
                                       const DeliveryStatistics& deliveries);
std::vector<SubscriptionResult> subscription_results(const Subjects& subjects, const DeliveryStatistics& deliveries,
                                                     const IntraProcessMatcher& buffers);

std::vector<CallResult> call_results(const Subjects& subjects, const ServiceMatcher& calls);

std::vector<ExecutionResult> execution_results(const Subjects& subjects, const ExecutionTracker& executions);
std::vector<ExecutorResult> executor_results(const Subjects& subjects, const ExecutorLoad& executors);

// Fills in what `results` tell of chains.
// What the version of ros2_tracing that recorded the trace does not tell, and what is estimated instead: whole
// sentences. The other results must be there.
std::vector<std::string> recording_remarks(const Ros2Results& results);
void add_chain_results(const Subjects& subjects, const ChainTracker& chains, const MessageMatcher& messages,
                       Ros2Results& results);

std::vector<NodeResult> node_results(const Subjects& subjects, const std::vector<CallbackResult>& callbacks);
std::vector<LifecycleResult> lifecycle_results(const Subjects& subjects, const LifecycleTracker& lifecycle,
                                               const AllocationCounter& allocations);

std::vector<UnmatchedResult> unmatched_results(const ObjectModel& model, const EventJoin& join,
                                               const DeliveryStatistics& deliveries);

}  // namespace tracing
