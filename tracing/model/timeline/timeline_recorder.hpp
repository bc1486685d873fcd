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
#include <optional>
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
  // Leaves out what end_of_first(timeline, records) is before. To be called before the first event.
  void keep_first(std::size_t records) { most_ = records; }

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
  // A publication that no flow has so far. It may be a message that nobody takes.
  struct Sent {
    Message message;
    std::uint64_t number = 0;  // Publication::number
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
  void finish_details(const InstanceIndex& index);
  void order_message_details();
  Message message_of(const Publication& publication);
  bool is_taken(const Sent& sent) const { return sent.number < taken_.size() && taken_[sent.number]; }
  void forget_taken();
  // Whether something that begins at this time is to be recorded. If so, it counts.
  bool is_wanted(std::int64_t time_ns);
  void join_messages();
  void link_messages(const InstanceIndex& index);

  // Its messages are flows as they are told until the publications are added that nobody took. Until they are linked,
  // the publishing instance of a message is the index of its detail.
  Timeline timeline_;
  std::size_t most_ = 0;  // 0: all
  std::size_t count_ = 0;
  std::int64_t last_ns_ = 0;            // the latest begin so far
  std::optional<std::int64_t> end_ns_;  // what begins then or later is left out
  std::vector<Sent> sent_;
  std::vector<bool> taken_;                  // by number: a flow has the publication; may be shorter
  std::vector<MessageDetail> sent_details_;  // as sent_
  std::unordered_map<ThreadId, Index, HashThreadId> threads_;
  std::map<std::pair<std::int64_t, std::string>, Index> other_threads_;
  ThreadId last_thread_id_;
  Index last_thread_ = kNone;
  bool with_details_ = false;
  TraceAnalysis* analysis_ = nullptr;           // that the details come from
  std::vector<MessageDetail> message_details_;  // of flows, as they were told
  std::vector<std::vector<Memory>> running_;    // by thread, innermost last
  std::vector<FinishedMemory> memory_;
};

}  // namespace tracing::timeline
