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
  // When the one of these instances ends that has begun before this time and runs then; the time itself if none does.
  std::int64_t end_of_running(const std::vector<timeline::Index>& instances, std::int64_t time_ns) const {
    const auto behind = std::lower_bound(
        instances.begin(), instances.end(), time_ns,
        [&](timeline::Index index, std::int64_t time) { return timeline_.instances[index].start_ns < time; });
    return behind == instances.begin() ? time_ns : std::max(time_ns, timeline_.instances[*(behind - 1)].end_ns);
  }

  const timeline::Timeline& timeline_;
  const FoundExecutors& executors_;
  std::vector<std::vector<timeline::Index>> by_thread_;
  std::vector<std::vector<timeline::Index>> threads_;  // by executor: those that ran something
  std::vector<std::vector<timeline::Index>> by_group_;
};

// What was ready when, and the run that it led to.
struct Way {
  timeline::Index instance = timeline::kNone;
  std::int64_t ready_ns = 0;
  bool is_near = false;  // a message of the same process
};

std::vector<Way> ways_of(const timeline::Timeline& timeline, const RunTimes& runs) {
  std::vector<Way> ways;
  for (const timeline::Message& message : timeline.messages) {
    if (message.receiving_instance == timeline::kNone) {
      continue;
    }
    const timeline::Instance& instance = timeline.instances[message.receiving_instance];
    if (instance.start_ns < message.published_ns) {
      continue;  // clocks of two machines
    }
    const timeline::Index publisher = message.publisher;
    const timeline::Index node = publisher == timeline::kNone ? timeline::kNone : timeline.publishers[publisher].node;
    const bool is_near =
        node != timeline::kNone && timeline.nodes[node].process == timeline.callbacks[instance.callback].process;
    ways.push_back({message.receiving_instance, message.published_ns, is_near});
  }
  std::vector<std::int64_t> due_ns(timeline.callbacks.size());  // of timers that ran: a time when one was due
  for (timeline::Index index = 0; index < timeline.instances.size(); ++index) {
    const timeline::Instance& instance = timeline.instances[index];
    const timeline::Callback& callback = timeline.callbacks[instance.callback];
    if (callback.owner != CallbackResult::Owner::kTimer || callback.period_ns <= 0) {
      continue;
    }
    // The first call comes when the executor begins, up to a period late.
    if (due_ns[instance.callback] == 0) {
      due_ns[instance.callback] = runs.first_due_ns(instance.callback, callback.period_ns);
      continue;
    }
    const std::int64_t late_ns = (instance.start_ns - due_ns[instance.callback]) % callback.period_ns;
    // What seems to be as late as that is a little before the time that is taken for the one when it is due.
    ways.push_back({index, instance.start_ns - (late_ns > callback.period_ns / 2 ? 0 : late_ns), false});
  }
  return ways;
}

struct Samples {
  struct Busy {
    bool is_near = false;
    std::int64_t ready_ns = 0;
    std::int64_t waited_ns = 0;  // until the executor was free
    std::int64_t gap_ns = 0;     // then
    Sample way() const { return {ready_ns, waited_ns + gap_ns}; }
    Sample gap() const { return {ready_ns + waited_ns, gap_ns}; }
  };
  std::vector<Sample> delays;
  std::vector<Sample> near_delays;
  std::vector<Busy> busy;
  std::vector<Sample> ways;

  std::vector<Sample>& delays_of(bool is_near) { return is_near ? near_delays : delays; }
  // If the executor was busy for a shorter time than a message takes at least, it did not keep the message.
  std::vector<Sample> take_gaps() {
    const auto least = [](const std::vector<Sample>& times) {
      const auto found = std::min_element(
          times.begin(), times.end(), [](const Sample& left, const Sample& right) { return left.value < right.value; });
      return found == times.end() ? 0 : found->value;
    };
    const std::int64_t least_ns[] = {least(delays), least(near_delays)};
    const bool is_never_free_for_near = near_delays.empty();
    std::vector<Sample> gaps;
    std::vector<Busy> kept;
    for (const Busy& one : busy) {
      if (one.waited_ns < least_ns[one.is_near ? 1 : 0]) {
        delays_of(one.is_near).push_back(one.way());
        continue;
      }
      gaps.push_back(one.gap());
      kept.push_back(one);
      // What a message needs at least is in the gap. Often the callback that sends it keeps the executor.
      if (one.is_near && is_never_free_for_near) {
        near_delays.push_back({one.ready_ns, one.gap_ns});
      }
    }
    busy = std::move(kept);
    return gaps;
  }
  void add_busy_to_delays() {
    for (const Busy& one : busy) {
      delays_of(one.is_near).push_back(one.way());
    }
  }
};

}  // namespace

std::vector<WayTimes> way_times(const Recording& recording, const FoundExecutors& executors, const RunTimes& runs) {
  const timeline::Timeline& timeline = recording.timeline;
  const Busy busy(timeline, executors);
  std::vector<Samples> samples(timeline.callbacks.size());
  // Of each executor: gaps of runs that a thread found ready when it had ended another one.
  std::vector<std::vector<Sample>> of_executor(executors.executors.size());
  for (const Way& way : ways_of(timeline, runs)) {
    const timeline::Instance& instance = timeline.instances[way.instance];
    Samples& of = samples[instance.callback];
    const std::int64_t before = busy.until(instance.callback, way.ready_ns);
    const std::size_t executor = executors.executor_of[instance.callback];
    const timeline::Instance* const last = busy.before(way.instance);
    const bool follows = last != nullptr && last->end_ns > way.ready_ns && last->end_ns <= instance.start_ns;
    if (follows && executor != FoundExecutors::kNone) {
      of_executor[executor].push_back({last->end_ns, instance.start_ns - last->end_ns});
    }
    // One that was sent before the last one got its callback was behind it all the way.
    const bool is_behind = follows && last->callback == instance.callback;
    if (before > way.ready_ns || is_behind) {
      // Of several runs that it had to wait for, the last one.
      const std::int64_t free_ns = follows ? std::max(before, last->end_ns) : before;
      of.busy.push_back(
          {way.is_near, way.ready_ns, free_ns - way.ready_ns, std::max<std::int64_t>(0, instance.start_ns - free_ns)});
    } else {
      of.delays_of(way.is_near).push_back({way.ready_ns, instance.start_ns - way.ready_ns});
    }
    of.ways.push_back({way.ready_ns, instance.start_ns - way.ready_ns});
  }
  std::vector<WayTimes> times(samples.size());
  for (std::size_t index = 0; index < samples.size(); ++index) {
    Samples& of = samples[index];
    std::vector<Sample> gaps = of.take_gaps();
    if (of.delays.empty()) {
      of.delays.swap(of.near_delays);
      for (Samples::Busy& one : of.busy) {
        one.is_near = false;
      }
    }
    if (of.delays.empty()) {
      // The executor was never free. What a message needs at least is in the gap.
      of.delays = gaps;
    }
    const std::size_t executor = executors.executor_of[index];
    const bool has_threads = executor != FoundExecutors::kNone && executors.executors[executor].threads.size() > 1;
    if (gaps.size() < kEnough && (gaps.empty() || has_threads)) {
      // An executor with several threads is seldom kept by its own callbacks, so its few gaps are those of a busy
      // machine, and its messages were on their way all the time. With fewer threads it will have many: such as its
      // threads had with other callbacks, or at most the time of a message that a thread is woken for.
      const bool has_others = executor != FoundExecutors::kNone && of_executor[executor].size() >= kEnough;
      const std::vector<Sample> own = std::exchange(gaps, has_others ? of_executor[executor] : of.delays);
      if (!own.empty()) {
        of.add_busy_to_delays();
      }
    }
    times[index] = {Distribution::of(std::move(of.delays)), Distribution::of(std::move(of.near_delays)),
                    Distribution::of(std::move(gaps)), Distribution::of(std::move(of.ways))};
  }
  return times;
}

void set_call_delays(const Recording& recording, const std::vector<Index>& client_of, System& system) {
  std::map<std::string, std::vector<Sample>> requests;
  std::map<Index, std::vector<Sample>> responses;
  for (const ServiceCall& call : recording.calls) {
    if (call.client == kNoObject || call.taken_ns == 0 || call.answered_ns == 0) {
      continue;
    }
    requests[recording.clients[call.client].name].push_back(
        {call.sent_ns, std::max<std::int64_t>(0, call.taken_ns - call.sent_ns)});
    responses[client_of[call.client]].push_back(
        {call.answered_ns, std::max<std::int64_t>(0, call.received_ns - call.answered_ns)});
  }
  for (Callback& callback : system.callbacks) {
    if (callback.kind == Callback::Kind::kService) {
      callback.delays = Distribution::of(requests[callback.service]);
    } else if (callback.kind == Callback::Kind::kClient) {
      callback.delays = Distribution::of(responses[callback.client]);
    } else {
      continue;
    }
    callback.ways = callback.delays;
  }
}

}  // namespace tracing::twin
