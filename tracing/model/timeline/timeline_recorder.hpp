// SPDX-License-Identifier: Apache-2.0
// Makes the timeline of a trace from what the analysis tells.
//
//   TimelineRecorder recorder;
//   TraceAnalysis analysis(&recorder);
//   TraceReader(directory).read(analysis);
//   const TraceResults results = analysis.finish();
//   const Timeline timeline = recorder.finish(analysis, results.overview);
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

class TimelineRecorder : public ExecutionSink {
 public:
  void on_callback_begin(const CallbackInstance& instance) override { thread_of(instance.thread); }
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& flow) override;
  void on_lifecycle_state(const LifecycleInterval& interval) override;
  // Of threads that have run a callback or published already: the other threads of a machine are too many.
  void on_thread_state(const ThreadInterval& interval) override;

  // To be called once, after the analysis has finished.
  Timeline finish(const TraceAnalysis& analysis, const TraceOverview& overview);

 private:
  struct HashThreadId {
    std::size_t operator()(const ThreadId& thread) const;
  };
  // A message on its way, whose callback is known by thread and time until all instances are in order.
  struct Flow {
    Message message;
    std::int64_t callback_begin_ns = 0;  // 0: no callback got it
  };

  Index thread_of(const ThreadId& id);
  Message message_of(const Publication& publication);
  void join_messages();
  void link_messages();

  Timeline timeline_;
  std::vector<Flow> flows_;  // first as they are told, then as timeline_.messages
  std::unordered_map<ThreadId, Index, HashThreadId> threads_;
  std::map<std::pair<std::int64_t, std::string>, Index> other_threads_;
  ThreadId last_thread_id_;
  Index last_thread_ = kNone;
};

}  // namespace tracing::timeline
