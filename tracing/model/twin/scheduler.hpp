// SPDX-License-Identifier: Apache-2.0
// The processors of a simulated machine, shared by threads as Linux does it, roughly: a SCHED_FIFO thread runs before
// all others until it blocks, one of a higher priority preempts it; ordinary threads get equal parts. There is one
// queue for all processors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tracing::twin {

class Scheduler {
 public:
  // How long an ordinary thread runs while others wait.
  static constexpr std::int64_t kSlice = 3'000'000;
  // A thread that wakes up preempts one that is this far ahead of it.
  static constexpr std::int64_t kWakeUp = 1'000'000;

  explicit Scheduler(std::size_t cpus) : cpus_(cpus) {}
  std::size_t add_thread(int priority);

  // The thread wants a processor for this long. It must not have work.
  void add_work(std::size_t thread, std::int64_t work_ns, std::int64_t now_ns);
  // When something happens next on the processors; nullopt: all are idle.
  std::optional<std::int64_t> next_ns() const;
  // Goes on to this time, which is at most next_ns(). Returns the threads that have done their work. Each of them may
  // go on with more, on the processor that it has; then settle() gives free processors to others.
  std::vector<std::size_t> advance(std::int64_t now_ns);
  void go_on(std::size_t thread, std::int64_t work_ns);
  void settle() { dispatch(std::nullopt); }

 private:
  struct Thread {
    int priority = 0;
    bool running = false;
    bool has_work = false;
    std::int64_t work_ns = 0;     // left
    std::int64_t virtual_ns = 0;  // that it has run, of an ordinary thread
    std::int64_t slice_ns = 0;    // left of its turn
    std::uint64_t since = 0;      // order in the queue
  };

  bool is_before(const Thread& left, const Thread& right) const;
  std::size_t running() const;
  // Gives free processors to waiting threads. `woken` may also take one that is not free.
  void dispatch(std::optional<std::size_t> woken);
  void start(std::size_t thread);
  void stop(std::size_t thread);
  std::optional<std::size_t> first_waiting() const;

  std::size_t cpus_;
  std::vector<Thread> threads_;
  std::int64_t now_ns_ = 0;
  std::uint64_t queued_ = 0;
};

}  // namespace tracing::twin
