// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/executor_waits.hpp"

#include <algorithm>
#include <iterator>

namespace tracing {

namespace {

// More than fit between the publication of a message and its take, unless an executor polls. That bounds the memory.
constexpr std::size_t kWaits = 1'024;

std::int64_t overlap_ns(std::int64_t begin_ns, std::int64_t end_ns, std::int64_t other_begin_ns,
                        std::int64_t other_end_ns) {
  return std::max<std::int64_t>(std::min(end_ns, other_end_ns) - std::max(begin_ns, other_begin_ns), 0);
}

// The first one for which `is_after` holds, as it does for all behind it. Usually it is one of the last.
template <class Interval, class IsAfter>
auto first_where(const std::deque<Interval>& intervals, const IsAfter& is_after) {
  constexpr int kLast = 4;
  auto first = intervals.end();
  for (int i = 0; i < kLast; ++i) {
    if (first == intervals.begin() || !is_after(*std::prev(first))) {
      return first;
    }
    --first;
  }
  return std::partition_point(intervals.begin(), first, [&](const Interval& one) { return !is_after(one); });
}

// The first one that ends after the time.
template <class Interval>
auto first_after(const std::deque<Interval>& intervals, std::int64_t time_ns) {
  return first_where(intervals, [time_ns](const Interval& interval) { return interval.end_ns > time_ns; });
}

}  // namespace

std::int64_t ThreadWaits::waited_ns(std::int64_t begin_ns, std::int64_t end_ns) const {
  std::int64_t waited_ns = waiting_ns == 0 ? 0 : overlap_ns(begin_ns, end_ns, waiting_ns, end_ns);
  if (newest.empty() || newest.back().end_ns <= begin_ns) {
    return waited_ns;
  }
  const auto first = first_after(newest, begin_ns);
  const auto behind_last = first_where(newest, [end_ns](const Wait& wait) { return wait.begin_ns > end_ns; });
  if (behind_last <= first) {
    return waited_ns;
  }
  const auto last = std::prev(behind_last);
  waited_ns += last->sum_ns - (first->sum_ns - (first->end_ns - first->begin_ns));
  waited_ns -= std::max<std::int64_t>(begin_ns - first->begin_ns, 0);
  waited_ns -= std::max<std::int64_t>(last->end_ns - end_ns, 0);
  return waited_ns;
}

ExecutorWaits::Process& ExecutorWaits::known(ProcessId process, ThreadWaits& thread) {
  if (process >= processes_.size()) {
    processes_.resize(process + 1);
  }
  Process& known = processes_[process];
  if (!thread.is_known) {
    thread.is_known = true;
    thread.executor = known.executors++;
    known.threads.push_back(&thread);
  }
  return known;
}

void ExecutorWaits::wait(const Origin& origin, ThreadWaits& thread) {
  Process& process = known(origin.process, thread);
  thread.waiting_ns = origin.time_ns;
  process.has_several_executors |= std::any_of(process.threads.begin(), process.threads.end(), [&](ThreadWaits* other) {
    return other != &thread && other->waiting_ns != 0;
  });
}

std::optional<std::int64_t> ExecutorWaits::look(const Origin& origin, ThreadWaits& thread) {
  known(origin.process, thread);
  thread.looked_ns = origin.time_ns;
  if (thread.waiting_ns == 0) {
    return std::nullopt;
  }
  const std::int64_t begin_ns = thread.waiting_ns;
  const std::int64_t sum_ns = thread.newest.empty() ? 0 : thread.newest.back().sum_ns;
  thread.newest.push_back({begin_ns, origin.time_ns, sum_ns + origin.time_ns - begin_ns});
  if (thread.newest.size() > kWaits) {
    thread.newest.pop_front();
  }
  thread.waiting_ns = 0;
  return begin_ns;
}

void ExecutorWaits::begin_callback(const Origin& origin, ThreadWaits& thread, ObjectId callback) {
  if (!thread.is_known || processes_[origin.process].threads.size() < 2) {
    return;
  }
  if (callback >= callbacks_.size()) {
    callbacks_.resize(callback + 1);
  }
  Callback& known = callbacks_[callback];
  if (known.last_thread != nullptr && known.last_thread->executor != thread.executor) {
    const std::uint32_t merged = known.last_thread->executor;
    for (ThreadWaits* other : processes_[origin.process].threads) {
      if (other->executor == merged) {
        other->executor = thread.executor;
      }
    }
  }
  if (known.running > 0 && known.last_thread != &thread) {
    known.is_reentrant = true;
    known.runs.clear();
  }
  known.last_thread = &thread;
  known.begin_ns = origin.time_ns;
  ++known.running;
}

void ExecutorWaits::end_callback(const Origin& origin, ObjectId callback) {
  if (callback >= callbacks_.size() || callbacks_[callback].running == 0) {
    return;
  }
  Callback& known = callbacks_[callback];
  --known.running;
  if (known.is_reentrant) {
    return;
  }
  known.runs.push_back({known.begin_ns, origin.time_ns});
  if (known.runs.size() > kWaits) {
    known.runs.pop_front();
  }
}

std::int64_t ExecutorWaits::taken_up_ns(ObjectId callback, const ThreadWaits& waiting, std::int64_t begin_ns,
                                        std::int64_t end_ns) const {
  if (callback >= callbacks_.size()) {
    return 0;
  }
  const std::deque<Run>& runs = callbacks_[callback].runs;
  std::int64_t taken_up_ns = 0;
  for (auto run = first_after(runs, begin_ns); run != runs.end() && run->begin_ns < end_ns; ++run) {
    taken_up_ns += waiting.waited_ns(std::max(begin_ns, run->begin_ns), std::min(end_ns, run->end_ns));
  }
  return taken_up_ns;
}

std::optional<std::int64_t> ExecutorWaits::free_ns(ProcessId process, const ThreadWaits& taking, ObjectId callback,
                                                   std::int64_t published_ns, std::int64_t taken_ns) const {
  if (!taking.is_known) {
    return std::nullopt;
  }
  // What was ready at its last look does not get ready once more while another thread waits.
  const std::int64_t end_ns = taking.waiting_ns == 0 ? taking.looked_ns : taken_ns;
  const Process& threads = processes_[process];
  bool tells = false;
  std::int64_t free_ns = 0;
  for (const ThreadWaits* thread : threads.threads) {
    if (threads.has_several_executors && thread->executor != taking.executor) {
      continue;
    }
    tells = tells || thread->waiting_ns != 0 || !thread->newest.empty();
    if (end_ns <= published_ns) {
      continue;
    }
    free_ns += thread->waited_ns(published_ns, end_ns);
    if (thread != &taking) {
      free_ns -= taken_up_ns(callback, *thread, published_ns, end_ns);
    }
  }
  return tells ? std::optional(free_ns) : std::nullopt;
}

}  // namespace tracing
