// SPDX-License-Identifier: Apache-2.0
// How busy the threads of executors are.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing {

struct ExecutorRecord {
  std::int64_t first_ns = 0;  // of what is known about the thread
  std::int64_t last_ns = 0;
  std::uint64_t waits = 0;  // 0: the executor records none, such as an EventsExecutor
  std::int64_t waited_ns = 0;
  std::uint64_t callbacks = 0;  // those that ran within another one don't count here
  std::int64_t callback_ns = 0;
  struct Inner {
    std::int64_t begin_ns = 0;
    std::int64_t took_ns = 0;
  };
  std::deque<Inner> inner;  // counted, but they may have run within a callback that has not ended yet
  // The longest time without a look for work: no other callback of the thread could begin.
  std::int64_t longest_busy_ns = 0;
  std::int64_t longest_busy_begin_ns = 0;
  ObjectId longest_callback = kNoObject;  // of all callbacks in that time
  std::int64_t busy_since_ns = 0;
  ObjectId candidate = kNoObject;  // the longest callback since then
  std::int64_t candidate_ns = 0;
  // After a callback or a wait, until the thread looks for work. Then another thread of the executor may wait for both.
  std::int64_t free_since_ns = 0;      // 0: it is not so
  std::int64_t process_waited_ns = 0;  // at that time
};

class ExecutorLoad : public ExecutionSink {
 public:
  void on_callback(const CallbackInstance& instance) override;
  void on_executor_wait(const ExecutorWait& wait) override;
  void on_executor_look(const ExecutorLook& look) override;

  const ThreadMap<ExecutorRecord>& records() const { return records_; }

 private:
  // The waits of all threads of a process.
  struct ProcessWaits {
    std::int64_t waited_ns = 0;
    ThreadId last_thread;
    std::int64_t last_end_ns = 0;
    bool has_several_executors = false;  // waits of two threads of one executor do not overlap
  };
  ProcessWaits& waits_of(ProcessId process) { return record_at(waits_, process); }

  ThreadMap<ExecutorRecord> records_;
  std::vector<ProcessWaits> waits_;  // by ProcessId
};

}  // namespace tracing
