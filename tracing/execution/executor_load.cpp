// SPDX-License-Identifier: Apache-2.0
#include "tracing/execution/executor_load.hpp"

#include <algorithm>

namespace tracing {

void ExecutorLoad::on_callback(const CallbackInstance& instance) {
  if (instance.nested || !instance.finished) return;
  ExecutorRecord& record = records_[instance.thread];
  if (record.first_ns == 0) record.first_ns = instance.begin_ns;
  record.last_ns = std::max(record.last_ns, instance.end_ns);
  const std::int64_t took = instance.end_ns - instance.begin_ns;
  ++record.callbacks;
  record.callback_ns += took;
  if (record.candidate == kNoObject || took > record.candidate_ns) {
    record.candidate = instance.callback;
    record.candidate_ns = took;
  }
}

void ExecutorLoad::on_executor_wait(const ExecutorWait& wait) {
  ExecutorRecord& record = records_[wait.thread];
  if (record.first_ns == 0) record.first_ns = wait.begin_ns;
  record.last_ns = std::max(record.last_ns, wait.end_ns);
  ++record.waits;
  record.waited_ns += wait.end_ns - wait.begin_ns;
  if (record.busy_since_ns != 0 && wait.begin_ns - record.busy_since_ns > record.longest_busy_ns) {
    record.longest_busy_ns = wait.begin_ns - record.busy_since_ns;
    record.longest_busy_begin_ns = record.busy_since_ns;
    record.longest_callback = record.candidate;
  }
  record.busy_since_ns = wait.end_ns;
  record.candidate = kNoObject;
  record.candidate_ns = 0;
}

}  // namespace tracing
