// SPDX-License-Identifier: Apache-2.0
// When the threads of executors waited for work, so that it is known how much of a time an executor was busy.
//
// Of the threads of one executor only one at a time waits for work, and the others wait for that one. Whatever one of
// them waits, the executor was free. ROS 2 records no executor: the threads of a process are taken for those of one
// executor until two of them wait at the same time. From then on, threads are of one executor if they ran the same
// callback.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "tracing/model/objects/objects.hpp"

namespace tracing {

// Of one thread.
struct ThreadWaits {
  struct Wait {
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    std::int64_t sum_ns = 0;  // of all waits so far, with this one
  };
  bool is_known = false;        // to ExecutorWaits
  std::uint32_t executor = 0;   // a label; only compared
  std::int64_t waiting_ns = 0;  // since when; 0: it does not wait
  std::int64_t looked_ns = 0;   // its last look for work; 0: none
  std::deque<Wait> newest;      // in the order of time

  // How much of the time it waited.
  std::int64_t waited_ns(std::int64_t begin_ns, std::int64_t end_ns) const;
};

class ExecutorWaits {
 public:
  // The thread begins to wait. `thread` must not move, and must outlive this object.
  void wait(const Origin& origin, ThreadWaits& thread);
  // The thread looks for something that is ready. Returns the begin of the wait that ends so.
  std::optional<std::int64_t> look(const Origin& origin, ThreadWaits& thread);
  void begin_callback(const Origin& origin, ThreadWaits& thread, ObjectId callback);
  void end_callback(const Origin& origin, ObjectId callback);

  // How much of the time from the publication of a message to its take the executor of the taking thread was free for
  // `callback`, which gets the message. Nullopt when the executor tells nothing.
  std::optional<std::int64_t> free_ns(ProcessId process, const ThreadWaits& taking, ObjectId callback,
                                      std::int64_t published_ns, std::int64_t taken_ns) const;

 private:
  struct Process {
    std::vector<ThreadWaits*> threads;
    bool has_several_executors = false;
    std::uint32_t executors = 0;
  };
  struct Run {
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
  };
  struct Callback {
    ThreadWaits* last_thread = nullptr;
    std::uint32_t running = 0;
    std::int64_t begin_ns = 0;
    bool is_reentrant = false;  // it ran in two threads at once
    std::deque<Run> runs;       // the newest ones, if several threads may run it
  };
  Process& known(ProcessId process, ThreadWaits& thread);
  // How much of a wait of another thread the callback ran, so that the message had to wait for it.
  std::int64_t taken_up_ns(ObjectId callback, const ThreadWaits& waiting, std::int64_t begin_ns,
                           std::int64_t end_ns) const;

  std::vector<Process> processes_;
  std::vector<Callback> callbacks_;  // by ObjectId
};

}  // namespace tracing
