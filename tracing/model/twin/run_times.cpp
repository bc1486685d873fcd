// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/run_times.hpp"

#include <algorithm>
#include <functional>

namespace tracing::twin {

namespace {

using State = ThreadInterval::State;

// A thread that sleeps is called later than that after its timer is due. One that has just ended a callback begins the
// next one sooner: it found the timer due when it ended.
constexpr std::int64_t kLongestGap = 20'000;
constexpr std::int64_t kGapsInPeriod = 100;  // a gap is at most that part of the timer's period
constexpr std::int64_t kLook = 1'000;        // a timer that is found due is due that long at least

// How much of a time each thread did what. States of one thread follow one another.
class States {
 public:
  explicit States(const timeline::Timeline& timeline) : by_thread_(timeline.threads.size()) {
    for (const timeline::ThreadState& state : timeline.states) {
      by_thread_[state.thread].push_back(&state);
    }
  }

  std::int64_t time_in(State what, const timeline::Instance& instance) const {
    const auto& states = by_thread_[instance.thread];
    auto state =
        std::upper_bound(states.begin(), states.end(), instance.start_ns,
                         [](std::int64_t time, const timeline::ThreadState* other) { return time < other->end_ns; });
    std::int64_t sum = 0;
    for (; state != states.end() && (*state)->begin_ns < instance.end_ns; ++state) {
      if ((*state)->state == what) {
        sum += std::min((*state)->end_ns, instance.end_ns) - std::max((*state)->begin_ns, instance.start_ns);
      }
    }
    return sum;
  }

 private:
  std::vector<std::vector<const timeline::ThreadState*>> by_thread_;
};

}  // namespace

RunTimes::RunTimes(const Recording& recording) : callbacks_(recording.timeline.callbacks.size()) {
  const timeline::Timeline& timeline = recording.timeline;
  const States states(timeline);
  std::vector<bool> sends(timeline.instances.size());
  for (const timeline::Message& message : timeline.messages) {
    if (message.publishing_instance != timeline::kNone && timeline.topics[message.topic] != "/rosout") {
      sends[message.publishing_instance] = true;
    }
  }
  std::vector<std::int64_t> ends(timeline.threads.size());  // of the run before
  for (std::size_t index = 0; index < timeline.instances.size(); ++index) {
    const timeline::Instance& instance = timeline.instances[index];
    Of& of = callbacks_[instance.callback];
    of.starts.push_back(instance.start_ns);
    of.ends_before.push_back(ends[instance.thread]);
    ends[instance.thread] = instance.finished ? instance.end_ns : 0;
    ++of.count;
    of.intra_process = of.intra_process || instance.intra_process;
    if (!instance.finished) {
      continue;
    }
    const std::int64_t length = instance.end_ns - instance.start_ns;
    const std::int64_t waited = states.time_in(State::kRunnable, instance);
    of.work_ns += static_cast<double>(length - waited);
    of.blocked_ns += static_cast<double>(states.time_in(State::kBlocked, instance));
    (sends[index] ? of.sending : of.silent).push_back({instance.start_ns, std::max<std::int64_t>(0, length - waited)});
  }
}

bool RunTimes::differ(const Of& callback) {
  constexpr std::size_t kEnoughOfEach = 5;
  return callback.sending.size() >= kEnoughOfEach && callback.silent.size() >= kEnoughOfEach;
}

Distribution RunTimes::sending(std::size_t callback) const {
  std::vector<Sample> values = callbacks_[callback].sending;
  if (!differ(callbacks_[callback])) {
    values.insert(values.end(), callbacks_[callback].silent.begin(), callbacks_[callback].silent.end());
  }
  return Distribution::of(std::move(values));
}

Distribution RunTimes::silent(std::size_t callback) const {
  return differ(callbacks_[callback]) ? Distribution::of(callbacks_[callback].silent) : Distribution();
}

double RunTimes::blocked(std::size_t callback) const {
  const Of& of = callbacks_[callback];
  return of.work_ns > 0 ? std::clamp(of.blocked_ns / of.work_ns, 0.0, 1.0) : 0;
}

std::int64_t RunTimes::first_due_ns(std::size_t callback, std::int64_t period_ns) const {
  const std::vector<std::int64_t>& starts = callbacks_[callback].starts;
  const std::vector<std::int64_t>& ends_before = callbacks_[callback].ends_before;
  if (starts.empty() || period_ns <= 0) {
    return 0;
  }
  // Where calls are within a period. All are late: most a little, some much, and the first one often, up to a period.
  // So the timer is due where half of them are nearest to one another, at the first of these.
  std::vector<std::int64_t> places;
  places.reserve(starts.size());
  for (const std::int64_t start : starts) {
    places.push_back((start - starts.front()) % period_ns);
  }
  std::sort(places.begin(), places.end());
  const std::size_t half = places.size() / 2;
  std::int64_t due = 0;
  std::int64_t least = period_ns;
  for (std::size_t place = 0; place < places.size(); ++place) {
    const std::size_t last = place + half;
    const std::int64_t width =
        last < places.size() ? places[last] - places[place] : places[last - places.size()] + period_ns - places[place];
    if (width < least) {
      least = width;
      due = places[place];
    }
  }
  // Most of these calls are late, too, because a thread that sleeps is woken late. No timer is called early, so it is
  // due at its earliest call. The first call does not count, and one in a hundred may be earlier: the timer was set
  // anew.
  const std::int64_t longest_gap = std::min(kLongestGap, period_ns / kGapsInPeriod);
  std::vector<std::int64_t> early;
  for (std::size_t call = 1; call < starts.size(); ++call) {
    const std::int64_t gap = starts[call] - ends_before[call];
    const bool is_found_due = gap >= 0 && gap < longest_gap;
    const std::int64_t known_ns = is_found_due ? ends_before[call] - kLook : starts[call];
    const std::int64_t before = (due + 2 * period_ns - (known_ns - starts.front()) % period_ns) % period_ns;
    if (before < period_ns / 2) {
      early.push_back(before);
    }
  }
  constexpr std::size_t kOneOf = 100;
  if (const std::size_t left_out = starts.size() / kOneOf; early.size() > left_out) {
    std::nth_element(early.begin(), early.begin() + static_cast<std::ptrdiff_t>(left_out), early.end(),
                     std::greater<>());
    due = (due + period_ns - early[left_out]) % period_ns;
  }
  const bool is_first_early = due < period_ns / 50;
  return starts.front() + due - (is_first_early ? 0 : period_ns);
}

}  // namespace tracing::twin
