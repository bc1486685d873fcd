// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/executor_load.hpp"

#include <algorithm>

namespace tracing {

namespace {

// Of a thread that has lost the end of a callback, all that follow look as if they ran within that one.
constexpr std::size_t kInner = 1'024;

// The thread looked for work again and again in this time, or another one did so for it.
void add_wait(ExecutorRecord& record, std::int64_t begin_ns, std::int64_t end_ns) {
  if (record.first_ns == 0) {
    record.first_ns = begin_ns;
  }
  record.last_ns = std::max(record.last_ns, end_ns);
  ++record.waits;
  record.waited_ns += end_ns - begin_ns;
  if (record.busy_since_ns != 0 && begin_ns - record.busy_since_ns > record.longest_busy_ns) {
    record.longest_busy_ns = begin_ns - record.busy_since_ns;
    record.longest_busy_begin_ns = record.busy_since_ns;
    record.longest_callback = record.candidate;
  }
  record.busy_since_ns = end_ns;
  record.candidate = kNoObject;
  record.candidate_ns = 0;
  record.free_since_ns = 0;
}

// Callbacks that ran within one that has ended are a part of it. Those within one that never ended are not: its end was
// lost, or an exception has left it.
void add_callback(ExecutorRecord& record, const CallbackInstance& instance) {
  const std::int64_t took = instance.end_ns - instance.begin_ns;
  ++record.callbacks;
  record.callback_ns += took;
  while (!record.inner.empty() && record.inner.back().begin_ns >= instance.begin_ns) {
    --record.callbacks;
    record.callback_ns -= record.inner.back().took_ns;
    record.inner.pop_back();
  }
  if (!instance.nested) {
    record.inner.clear();
    return;
  }
  record.inner.push_back({instance.begin_ns, took});
  if (record.inner.size() > kInner) {
    record.inner.pop_front();
  }
}

}  // namespace

void ExecutorLoad::on_callback(const CallbackInstance& instance) {
  ExecutorRecord& record = records_[instance.thread];
  if (!instance.finished) {
    record.inner.clear();
    return;
  }
  if (record.first_ns == 0 || instance.begin_ns < record.first_ns) {
    record.first_ns = instance.begin_ns;
  }
  record.last_ns = std::max(record.last_ns, instance.end_ns);
  const std::int64_t took = instance.end_ns - instance.begin_ns;
  add_callback(record, instance);
  if (record.candidate == kNoObject || took > record.candidate_ns) {
    record.candidate = instance.callback;
    record.candidate_ns = took;
  }
  record.free_since_ns = instance.end_ns;
  record.process_waited_ns = waits_of(instance.thread.process).waited_ns;
}

void ExecutorLoad::on_executor_wait(const ExecutorWait& wait) {
  ExecutorRecord& record = records_[wait.thread];
  add_wait(record, wait.begin_ns, wait.end_ns);
  ProcessWaits& waits = waits_of(wait.thread.process);
  waits.waited_ns += wait.end_ns - wait.begin_ns;
  if (!(wait.thread == waits.last_thread) && wait.begin_ns < waits.last_end_ns) {
    waits.has_several_executors = true;
  }
  waits.last_thread = wait.thread;
  waits.last_end_ns = std::max(waits.last_end_ns, wait.end_ns);
  // What it does next may have no event. If another executor of the process waits meanwhile, that tells nothing.
  if (waits.has_several_executors) {
    return;
  }
  record.free_since_ns = wait.end_ns;
  record.process_waited_ns = waits.waited_ns;
}

// With several threads, the one that waits for work holds a lock, at which the others wait to look for work. So a
// thread does nothing from its last callback until this look for as long as others have waited meanwhile.
void ExecutorLoad::on_executor_look(const ExecutorLook& look) {
  ExecutorRecord& record = records_[look.thread];
  if (record.free_since_ns == 0) {
    return;
  }
  const std::int64_t idle =
      std::min(waits_of(look.thread.process).waited_ns - record.process_waited_ns, look.time_ns - record.free_since_ns);
  record.free_since_ns = 0;
  if (idle > 0) {
    add_wait(record, look.time_ns - idle, look.time_ns);
  }
}

}  // namespace tracing
