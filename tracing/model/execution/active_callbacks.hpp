// SPDX-License-Identifier: Apache-2.0
// The callbacks that run on each thread, and what their threads do meanwhile, as events of the kernel's scheduler tell.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"

namespace tracing {

class ActiveCallbacks {
 public:
  // The parts of a callback's duration.
  struct Parts {
    std::int64_t running_ns = 0;
    std::int64_t runnable_ns = 0;  // waited for a processor
    std::int64_t blocked_ns = 0;
  };

  void begin(const CallbackInstance& instance) {
    threads_[instance.thread].active.push_back({instance.callback, instance.begin_ns, 0, 0});
  }
  // nullopt: the instance has no end in the trace, or its thread is not in events of the scheduler.
  std::optional<Parts> end(const CallbackInstance& instance);

  // The thread runs whenever a callback begins or ends, so that other intervals lie within callbacks as a whole. Calls
  // `waited` with each callback that waited for a processor, and for how long.
  template <typename Waited>
  void add(const ThreadInterval& interval, const Waited& waited) {
    Thread& thread = threads_[interval.thread];
    thread.is_scheduled = true;
    if (interval.state == ThreadInterval::State::kRunning) {
      return;
    }
    for (Active& active : thread.active) {
      const std::int64_t took = interval.end_ns - std::max(interval.begin_ns, active.begin_ns);
      if (interval.state == ThreadInterval::State::kBlocked) {
        active.blocked_ns += took;
        continue;
      }
      active.runnable_ns += took;
      waited(active.callback, took);
    }
  }

  // kNoObject when none runs.
  ObjectId innermost(const ThreadId& thread) {
    const Thread* const found = threads_.find(thread);
    return found == nullptr || found->active.empty() ? kNoObject : found->active.back().callback;
  }

 private:
  struct Active {
    ObjectId callback = kNoObject;
    std::int64_t begin_ns = 0;
    std::int64_t runnable_ns = 0;
    std::int64_t blocked_ns = 0;
  };
  struct Thread {
    std::vector<Active> active;  // innermost last
    bool is_scheduled = false;   // the kernel has told of it
  };

  ThreadMap<Thread> threads_;
};

}  // namespace tracing
