// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/delays.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace tracing::twin {

namespace {

constexpr std::size_t kEnough = 20;

// The most callbacks that ran at the same time, between two times.
class Load {
 public:
  explicit Load(const std::vector<timeline::Instance>& instances) {
    for (const timeline::Instance& instance : instances) {
      changes_.push_back({instance.start_ns, 1});
      changes_.push_back({instance.end_ns, -1});
    }
    std::sort(changes_.begin(), changes_.end(), [](const Change& left, const Change& right) {
      return left.time_ns != right.time_ns ? left.time_ns < right.time_ns : left.running < right.running;
    });
    int running = 0;
    for (Change& change : changes_) {
      running += change.running;
      change.running = running;
    }
  }

  int most(std::int64_t begin_ns, std::int64_t end_ns) const {
    auto change = std::upper_bound(changes_.begin(), changes_.end(), begin_ns,
                                   [](std::int64_t time, const Change& other) { return time < other.time_ns; });
    int most = change == changes_.begin() ? 0 : (change - 1)->running;
    for (; change != changes_.end() && change->time_ns < end_ns; ++change) {
      most = std::max(most, change->running);
    }
    return most;
  }

 private:
  struct Change {
    std::int64_t time_ns = 0;
    int running = 0;  // the difference, then the number from this time on
  };
  std::vector<Change> changes_;
};

// When each executor had a free thread, and each group nothing that ran.
class Busy {
 public:
  Busy(const timeline::Timeline& timeline, const FoundExecutors& executors)
      : timeline_(timeline),
        executors_(executors),
        by_thread_(timeline.threads.size()),
        threads_(executors.executors.size()),
        by_group_(executors.groups.size()) {
    for (timeline::Index index = 0; index < timeline.instances.size(); ++index) {
      const timeline::Instance& instance = timeline.instances[index];
      std::vector<timeline::Index>& of_thread = by_thread_[instance.thread];
      if (of_thread.empty() && executors.executor_of[instance.callback] != FoundExecutors::kNone) {
        threads_[executors.executor_of[instance.callback]].push_back(instance.thread);
      }
      of_thread.push_back(index);
      const std::size_t group = executors.group_of[instance.callback];
      if (group != FoundExecutors::kNone && !executors.groups[group].reentrant) {
        by_group_[group].push_back(index);
      }
    }
  }

  // The run of the same thread before this one, or null.
  const timeline::Instance* before(timeline::Index index) const {
    const timeline::Instance& instance = timeline_.instances[index];
    const std::vector<timeline::Index>& of_thread = by_thread_[instance.thread];
    const auto place = std::lower_bound(of_thread.begin(), of_thread.end(), index);
    return place == of_thread.begin() ? nullptr : &timeline_.instances[*(place - 1)];
  }

  // From this time on the callback could have run, as far as its executor and its group are concerned.
  std::int64_t until(timeline::Index callback, std::int64_t time_ns) const {
    std::int64_t until = time_ns;
    const std::size_t executor = executors_.executor_of[callback];
    if (executor != FoundExecutors::kNone) {
      const std::size_t unseen = executors_.executors[executor].threads.size() - threads_[executor].size();
      std::int64_t first = unseen > 0 ? time_ns : std::numeric_limits<std::int64_t>::max();
      for (const timeline::Index thread : threads_[executor]) {
        first = std::min(first, end_of_running(by_thread_[thread], time_ns));
      }
      until = std::max(until, first);
    }
    if (const std::size_t group = executors_.group_of[callback]; group != FoundExecutors::kNone) {
      until = std::max(until, end_of_running(by_group_[group], time_ns));
    }
    return until;
  }

 private:
  // When the one of these instances ends that runs at this time; the time itself if none does.
  std::int64_t end_of_running(const std::vector<timeline::Index>& instances, std::int64_t time_ns) const {
    const auto behind = std::upper_bound(
        instances.begin(), instances.end(), time_ns,
        [&](std::int64_t time, timeline::Index index) { return time < timeline_.instances[index].start_ns; });
    return behind == instances.begin() ? time_ns : std::max(time_ns, timeline_.instances[*(behind - 1)].end_ns);
  }

  const timeline::Timeline& timeline_;
  const FoundExecutors& executors_;
  std::vector<std::vector<timeline::Index>> by_thread_;
  std::vector<std::vector<timeline::Index>> threads_;  // by executor: those that ran something
  std::vector<std::vector<timeline::Index>> by_group_;
};

struct Samples {
  std::vector<std::int64_t> quiet;
  std::vector<std::int64_t> loaded;
  std::vector<std::int64_t> gaps;
};

}  // namespace

std::vector<WayTimes> way_times(const Recording& recording, const FoundExecutors& executors, std::size_t cpus) {
  const timeline::Timeline& timeline = recording.timeline;
  const Load load(timeline.instances);
  const int quiet_load = std::max(1, static_cast<int>(cpus) - 1);
  const Busy busy(timeline, executors);
  std::vector<Samples> samples(timeline.callbacks.size());
  // Of each executor: gaps of runs that a thread found ready when it had ended another one.
  std::vector<std::vector<std::int64_t>> of_executor(executors.executors.size());
  for (const timeline::Message& message : timeline.messages) {
    if (message.receiving_instance == timeline::kNone) {
      continue;
    }
    const timeline::Instance& instance = timeline.instances[message.receiving_instance];
    Samples& of = samples[instance.callback];
    const std::int64_t before = busy.until(instance.callback, message.published_ns);
    const std::int64_t delay = instance.start_ns - message.published_ns;
    if (delay < 0) {
      continue;  // clocks of two machines
    }
    const std::size_t executor = executors.executor_of[instance.callback];
    const timeline::Instance* const last = busy.before(message.receiving_instance);
    if (executor != FoundExecutors::kNone && last != nullptr && last->end_ns > message.published_ns &&
        last->end_ns <= instance.start_ns) {
      of_executor[executor].push_back(instance.start_ns - last->end_ns);
    }
    if (before > message.published_ns) {
      of.gaps.push_back(std::max<std::int64_t>(0, instance.start_ns - before));
    } else {
      (load.most(message.published_ns, instance.start_ns) <= quiet_load ? of.quiet : of.loaded).push_back(delay);
    }
  }
  std::vector<WayTimes> times(samples.size());
  for (std::size_t index = 0; index < samples.size(); ++index) {
    Samples& of = samples[index];
    if (of.quiet.size() < kEnough) {
      of.quiet.insert(of.quiet.end(), of.loaded.begin(), of.loaded.end());
    }
    if (of.quiet.empty()) {
      // The executor was never free. What a message needs at least is in the gap.
      of.quiet = of.gaps;
    }
    const std::size_t executor = executors.executor_of[index];
    const bool has_threads = executor != FoundExecutors::kNone && executors.executors[executor].threads.size() > 1;
    if (of.gaps.size() < kEnough && (of.gaps.empty() || has_threads)) {
      // An executor with several threads is seldom kept by its own callbacks, so its few gaps are those of a busy
      // machine. With fewer threads it will have many: such as its threads had with other callbacks, or at most the
      // time of a message that a thread is woken for.
      const bool has_others = executor != FoundExecutors::kNone && of_executor[executor].size() >= kEnough;
      of.gaps = has_others ? of_executor[executor] : of.quiet;
    }
    times[index] = {Distribution::of(std::move(of.quiet)), Distribution::of(std::move(of.gaps))};
  }
  return times;
}

void set_call_delays(const Recording& recording, const std::vector<Index>& client_of, System& system) {
  std::map<std::string, std::vector<std::int64_t>> requests;
  std::map<Index, std::vector<std::int64_t>> responses;
  for (const ServiceCall& call : recording.calls) {
    if (call.client == kNoObject || call.taken_ns == 0 || call.answered_ns == 0) {
      continue;
    }
    requests[recording.clients[call.client].name].push_back(std::max<std::int64_t>(0, call.taken_ns - call.sent_ns));
    responses[client_of[call.client]].push_back(std::max<std::int64_t>(0, call.received_ns - call.answered_ns));
  }
  for (Callback& callback : system.callbacks) {
    if (callback.kind == Callback::Kind::kService) {
      callback.delays = Distribution::of(requests[callback.service]);
    } else if (callback.kind == Callback::Kind::kClient) {
      callback.delays = Distribution::of(responses[callback.client]);
    }
  }
}

}  // namespace tracing::twin
