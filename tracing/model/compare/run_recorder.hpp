// SPDX-License-Identifier: Apache-2.0
// Collects the samples of a run while its trace is read.
//
//   RunRecorder recorder;
//   TraceAnalysis analysis(&recorder);
//   recorder.use(analysis.objects());
//   TraceReader(directory).read(analysis);
//   const TraceResults results = analysis.finish();
//   const RunSummary run = recorder.finish(analysis, results);
//
// The memory grows with the number of callbacks, subscriptions and chains, not with the length of the run.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/compare/kept_samples.hpp"
#include "tracing/model/compare/run_summary.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"
#include "tracing/model/messages/chain_tracker.hpp"

namespace tracing::compare {

class RunRecorder : public ExecutionSink {
 public:
  // To be called before anything happens; they must outlive this object.
  void use(const ObjectModel& objects) { objects_ = &objects; }

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& message) override;
  void on_message_link(const MessageLink& link) override { chains_.on_message_link(link); }
  void on_call(const ServiceCall& call) override;

  // To be called once, after the analysis has finished. Directory and remark are left to the caller.
  RunSummary finish(const TraceAnalysis& analysis, const TraceResults& results);

 private:
  struct Chains : ChainTracker {
    std::vector<KeptSamples> responses;  // by path
    void on_response(PathId path, std::int64_t input_ns, std::int64_t output_ns) override;
  };
  struct Callback {
    // [0]: of runs that sent nothing; [1]: of those that sent messages.
    std::array<KeptSamples, 2> durations;
    KeptSamples intervals;
    std::int64_t last_begin_ns = 0;
    // With events of the kernel's scheduler: the parts of the duration.
    std::array<KeptSamples, 2> running;
    KeptSamples waiting;
    KeptSamples blocked;
  };
  struct Hop {
    KeptSamples latency;
    KeptSamples transport;
    KeptSamples executor;
    bool is_estimated = false;
  };

  // A callback that runs.
  struct Active {
    std::int64_t begin_ns = 0;
    bool sends = false;
  };
  // Whether the instance, which ends, has sent messages.
  bool has_sent(const CallbackInstance& instance);
  // Whether a message on the path waits in a node for a timer, or for other messages.
  bool waits(PathId path) const;

  std::set<ProcessId> senders_;
  ThreadMap<std::vector<Active>> active_;  // innermost last
  const ObjectModel* objects_ = nullptr;
  std::vector<Callback> callbacks_;                             // by ObjectId
  std::vector<Hop> hops_;                                       // by ObjectId of the subscription
  std::map<std::pair<ObjectId, ObjectId>, KeptSamples> calls_;  // by client and service
  Chains chains_;
};

}  // namespace tracing::compare
