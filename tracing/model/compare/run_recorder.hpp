// SPDX-License-Identifier: Apache-2.0
// Collects the samples of a run while its trace is read.
//
//   RunRecorder recorder;
//   TraceAnalysis analysis(&recorder);
//   TraceReader(directory).read(analysis);
//   const TraceResults results = analysis.finish();
//   const RunSummary run = recorder.finish(analysis, results);
//
// The memory grows with the number of callbacks, subscriptions and chains, not with the length of the run.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/compare/kept_samples.hpp"
#include "tracing/model/compare/run_summary.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/messages/chain_tracker.hpp"

namespace tracing::compare {

class RunRecorder : public ExecutionSink {
 public:
  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override { chains_.on_publication(publication); }
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
    KeptSamples durations;
    KeptSamples intervals;
    std::int64_t last_begin_ns = 0;
    // With events of the kernel's scheduler: the parts of the duration.
    KeptSamples running;
    KeptSamples waiting;
    KeptSamples blocked;
  };
  struct Hop {
    KeptSamples latency;
    KeptSamples transport;
    KeptSamples executor;
    bool is_estimated = false;
  };

  std::vector<Callback> callbacks_;                             // by ObjectId
  std::vector<Hop> hops_;                                       // by ObjectId of the subscription
  std::map<std::pair<ObjectId, ObjectId>, KeptSamples> calls_;  // by client and service
  Chains chains_;
};

}  // namespace tracing::compare
