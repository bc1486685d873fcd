// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/scheduler.hpp"

#include <algorithm>

namespace tracing::twin {

std::size_t Scheduler::add_thread(int priority) {
  threads_.push_back({.priority = priority});
  return threads_.size() - 1;
}

bool Scheduler::is_before(const Thread& left, const Thread& right) const {
  if (left.priority != right.priority) {
    return left.priority > right.priority;
  }
  if (left.priority == 0 && left.virtual_ns != right.virtual_ns) {
    return left.virtual_ns < right.virtual_ns;
  }
  return left.since < right.since;
}

std::size_t Scheduler::running() const {
  return static_cast<std::size_t>(
      std::count_if(threads_.begin(), threads_.end(), [](const Thread& thread) { return thread.running; }));
}

std::optional<std::size_t> Scheduler::first_waiting() const {
  std::optional<std::size_t> first;
  for (std::size_t index = 0; index < threads_.size(); ++index) {
    const Thread& thread = threads_[index];
    if (thread.has_work && !thread.running && (!first || is_before(thread, threads_[*first]))) {
      first = index;
    }
  }
  return first;
}

void Scheduler::start(std::size_t thread) {
  threads_[thread].running = true;
  threads_[thread].slice_ns = kSlice;
}

void Scheduler::stop(std::size_t thread) {
  threads_[thread].running = false;
  threads_[thread].since = ++queued_;
}

void Scheduler::dispatch(std::optional<std::size_t> woken) {
  for (std::size_t free = cpus_ - std::min(cpus_, running()); free > 0; --free) {
    const auto next = first_waiting();
    if (!next) {
      return;
    }
    start(*next);
  }
  if (!woken || threads_[*woken].running) {
    return;
  }
  std::optional<std::size_t> last;
  for (std::size_t index = 0; index < threads_.size(); ++index) {
    if (threads_[index].running && (!last || is_before(threads_[*last], threads_[index]))) {
      last = index;
    }
  }
  const Thread& waking = threads_[*woken];
  const Thread& victim = threads_[*last];
  const bool preempts = waking.priority > victim.priority || (waking.priority == 0 && victim.priority == 0 &&
                                                              waking.virtual_ns + kWakeUp < victim.virtual_ns);
  if (preempts) {
    stop(*last);
    start(*woken);
  }
}

void Scheduler::add_work(std::size_t index, std::int64_t work_ns, std::int64_t now_ns) {
  now_ns_ = now_ns;
  Thread& thread = threads_[index];
  thread.has_work = true;
  thread.work_ns = std::max<std::int64_t>(0, work_ns);
  thread.since = ++queued_;
  // A thread that has slept does not get all of that time afterwards.
  std::int64_t least = thread.virtual_ns;
  bool any = false;
  for (const Thread& other : threads_) {
    if (&other != &thread && other.has_work && other.priority == 0) {
      least = any ? std::min(least, other.virtual_ns) : other.virtual_ns;
      any = true;
    }
  }
  thread.virtual_ns = std::max(thread.virtual_ns, least - kSlice);
  dispatch(index);
}

std::optional<std::int64_t> Scheduler::next_ns() const {
  std::optional<std::int64_t> next;
  const bool others_wait = first_waiting().has_value();
  for (const Thread& thread : threads_) {
    if (thread.running) {
      const bool has_turns = others_wait && thread.priority == 0;
      const std::int64_t until = has_turns ? std::min(thread.work_ns, thread.slice_ns) : thread.work_ns;
      next = std::min(next.value_or(now_ns_ + until), now_ns_ + until);
    }
  }
  return next;
}

std::vector<std::size_t> Scheduler::advance(std::int64_t now_ns) {
  const std::int64_t passed = now_ns - now_ns_;
  now_ns_ = now_ns;
  std::vector<std::size_t> done;
  for (std::size_t index = 0; index < threads_.size(); ++index) {
    Thread& thread = threads_[index];
    if (!thread.running) {
      continue;
    }
    thread.work_ns -= passed;
    thread.virtual_ns += passed;
    thread.slice_ns = std::max<std::int64_t>(0, thread.slice_ns - passed);
    if (thread.work_ns <= 0) {
      thread.running = false;
      thread.has_work = false;
      done.push_back(index);
    }
  }
  const auto waiting = first_waiting();
  for (std::size_t index = 0; waiting && index < threads_.size(); ++index) {
    Thread& thread = threads_[index];
    if (thread.running && thread.priority == 0 && thread.slice_ns == 0) {
      stop(index);  // the next one in the queue may be this one again
    }
  }
  return done;
}

void Scheduler::go_on(std::size_t index, std::int64_t work_ns) {
  Thread& thread = threads_[index];
  thread.has_work = true;
  thread.running = true;
  thread.work_ns = std::max<std::int64_t>(0, work_ns);
}

}  // namespace tracing::twin
