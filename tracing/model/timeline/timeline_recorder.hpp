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
#include "tracing/model/timeline/instance_index.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

class TimelineRecorder : public ExecutionSink {
 public:
  TimelineRecorder() = default;
  // Also records Timeline::details. To be called before the first event.
  void record_details(TraceAnalysis& analysis);

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& flow) override;
  void on_lifecycle_state(const LifecycleInterval& interval) override;
  void on_call(const ServiceCall& call) override;
  void on_open_call(const ServiceCall& call) override { on_call(call); }
  void on_executor_wait(const ExecutorWait& wait) override;
  void on_allocation(const Allocation& allocation) override;
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

  // What a callback that runs has asked for.
  struct Memory {
    ObjectId callback = kNoObject;
    std::int64_t begin_ns = 0;
    std::uint64_t calls = 0;
    std::uint64_t bytes = 0;
  };
  struct FinishedMemory {
    Index thread = kNone;
    Memory memory;
  };

  Index thread_of(const ThreadId& id);
  void end_memory(const CallbackInstance& instance, Index thread);
  void finish_details(const TraceAnalysis& analysis, const InstanceIndex& index);
  Message message_of(const Publication& publication);
  void join_messages();
  void link_messages(const InstanceIndex& index);

  Timeline timeline_;
  // Until messages are linked, the publishing instance of a message is the index of its detail.
  std::vector<Flow> flows_;  // first as they are told, then as timeline_.messages
  std::unordered_map<ThreadId, Index, HashThreadId> threads_;
  std::map<std::pair<std::int64_t, std::string>, Index> other_threads_;
  ThreadId last_thread_id_;
  Index last_thread_ = kNone;
  bool with_details_ = false;
  std::vector<MessageDetail> message_details_;  // first of all publications and flows, as they were told
  std::vector<std::vector<Memory>> running_;    // by thread, innermost last
  std::vector<FinishedMemory> memory_;
};

}  // namespace tracing::timeline
