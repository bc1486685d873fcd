// SPDX-License-Identifier: Apache-2.0
// The whole analysis of a trace, as the sink of one reading.
//
//   TraceAnalysis analysis;
//   TraceReader(directory).read(analysis);
//   const TraceResults results = analysis.finish();
//
// After a TraceReadError finish() still gives the results of the events before the damage.
#pragma once

#include <string>
#include <utility>

#include "tracing/decode/reader/caret_events.hpp"
#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/analysis/inits_in_order.hpp"
#include "tracing/model/analysis/overview_counter.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/analysis/ros2_analysis.hpp"
#include "tracing/model/analysis/start_tracker.hpp"
#include "tracing/model/execution/allocation_decoder.hpp"
#include "tracing/model/execution/write_decoder.hpp"

namespace tracing {

class TraceAnalysis : public TraceSink {
 public:
  // Tells `sink`, unless it is null, what happened while the trace is read. The sink must outlive the analysis.
  // `chains` are those that the user has named.
  explicit TraceAnalysis(ExecutionSink* sink = nullptr, std::vector<ChainDefinition> chains = {})
      : ros2_(sink, std::move(chains)) {}
  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;

  // Before finish(): a part of the trace could not be read or is missing, so that all results may be wrong.
  void doubt_all() { overview_.doubt_all(); }
  // To be called once, at the end. Tells the sink what was not finished.
  TraceResults finish();

  // So far: Ros2Analysis::missed_periods() and dropped_messages().
  std::vector<std::uint64_t> missed_periods() const { return ros2_.missed_periods(); }
  std::vector<std::uint64_t> dropped_messages() const { return ros2_.dropped_messages(); }
  std::uint64_t dropped_messages(ObjectId subscription) const { return ros2_.dropped_messages(subscription); }

  // As of LauncherEventList; so far.
  void keep_last_launcher_events(std::size_t count) { starts_.keep_last_launcher_events(count); }
  std::vector<LauncherEventResult> launcher_events() const { return starts_.launcher_events(); }

  // As those of Ros2Analysis.
  void keep_chain_passages() { ros2_.keep_chain_passages(); }
  const ChainTracker& chains() const { return ros2_.chains(); }
  ChainTracker::Passages take_chain_passages() { return ros2_.take_chain_passages(); }

  // What the ids of the sink refer to.
  const ObjectModel& objects() const { return ros2_.model(); }
  const CallbackGroups& groups() const { return ros2_.groups(); }
  const std::vector<ProcessObject>& processes() const { return overview_.processes().processes(); }
  std::string host_of(ProcessId process) const { return overview_.processes().host_of(process); }
  // Where each process is in TraceResults::overview.processes; nullopt when it is not there.
  std::vector<std::optional<ProcessIndex>> places() const { return overview_.places(); }

 private:
  void release_inits(ProcessId process) {
    if (!inits_.empty()) {
      inits_.release(process, [this](const InitsInOrder::Kept& kept) { tell(kept.origin, kept.event); });
    }
  }
  [[gnu::noinline]] void learn();
  [[gnu::noinline]] void on_other_event(const Event& event, const Origin& origin);
  void on_caret_event(const Origin& origin, const ros2::CaretDecoder::Decoded& decoded);
  void tell(const Origin& origin, const ros2::KnownCaretEvent& event);

  OverviewCounter overview_;
  StartTracker starts_;
  Ros2Analysis ros2_;
  std::vector<std::string> warnings_;
  ros2::Decoder decoder_{[this](const std::string& problem) { warnings_.push_back(problem); }};
  ros2::CaretDecoder caret_;
  InitsInOrder inits_;
  ros2::ObjectEndDecoder ends_;
  ros2::ExecutionEventDecoder executions_;
  ros2::LifecycleStateDecoder lifecycle_states_;
  ros2::EndpointQosDecoder endpoint_qos_;
  AllocationDecoder allocations_;
  WriteDecoder writes_;
  ByEventClass<bool> of_kernel_;  // its events have no provider in their names
  std::size_t learned_ = 0;       // processes that the model knows of
  bool lacks_thread_context_ = false;
};

}  // namespace tracing
