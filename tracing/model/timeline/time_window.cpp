// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/time_window.hpp"

#include <algorithm>

namespace tracing::timeline {

namespace {

std::size_t instances_before(const Timeline& timeline, std::int64_t time_ns) {
  const auto found =
      std::lower_bound(timeline.instances.begin(), timeline.instances.end(), time_ns,
                       [](const Instance& instance, std::int64_t time) { return instance.start_ns < time; });
  return static_cast<std::size_t>(found - timeline.instances.begin());
}

std::size_t messages_before(const Timeline& timeline, std::int64_t time_ns) {
  const auto found =
      std::lower_bound(timeline.messages.begin(), timeline.messages.end(), time_ns,
                       [](const Message& message, std::int64_t time) { return message.published_ns < time; });
  return static_cast<std::size_t>(found - timeline.messages.begin());
}

std::size_t states_before(const Timeline& timeline, std::int64_t time_ns) {
  const auto found =
      std::lower_bound(timeline.states.begin(), timeline.states.end(), time_ns,
                       [](const ThreadState& state, std::int64_t time) { return state.begin_ns < time; });
  return static_cast<std::size_t>(found - timeline.states.begin());
}

// Erases all elements but [first, last).
template <class List>
void keep(List& list, std::size_t first, std::size_t last) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(last), list.end());
  list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first));
}

// Keeps the parts of intervals that lie within the timeline.
template <class Interval>
void cut(std::vector<Interval>& intervals, const Timeline& timeline) {
  std::erase_if(intervals, [&timeline](const Interval& interval) {
    return interval.end_ns <= timeline.begin_ns || interval.begin_ns >= timeline.end_ns;
  });
  for (Interval& interval : intervals) {
    interval.begin_ns = std::max(interval.begin_ns, timeline.begin_ns);
    interval.end_ns = std::min(interval.end_ns, timeline.end_ns);
  }
}

// What refers to instances loses those that are gone.
void keep_details(Details& details, std::int64_t begin_ns, std::int64_t end_ns, const std::size_t (&instances)[2],
                  const std::size_t (&messages)[2]) {
  if (!details.messages.empty()) {
    keep(details.messages, messages[0], std::max(messages[0], messages[1]));
  }
  const auto is_outside = [&](std::int64_t time_ns) { return time_ns < begin_ns || time_ns >= end_ns; };
  std::erase_if(details.calls, [&](const Call& call) { return is_outside(call.begin_ns()); });
  std::erase_if(details.waits, [&](const Wait& wait) { return is_outside(wait.begin_ns); });
  std::erase_if(details.passages, [&](const ChainPassage& passage) { return is_outside(passage.input_ns); });
  const auto is_gone = [&](Index instance) { return instance < instances[0] || instance >= instances[1]; };
  std::erase_if(details.memory, [&](const InstanceMemory& memory) { return is_gone(memory.instance); });
  for (InstanceMemory& memory : details.memory) {
    memory.instance -= static_cast<Index>(instances[0]);
  }
  for (ChainHop& hop : details.hops) {
    hop.instance = is_gone(hop.instance) ? kNone : hop.instance - static_cast<Index>(instances[0]);
  }
}

}  // namespace

void keep_window(Timeline& timeline, std::int64_t begin_ns, std::int64_t end_ns) {
  // What happens at the very end belongs to the timeline.
  const std::int64_t behind_ns = end_ns > timeline.end_ns ? timeline.end_ns + 1 : end_ns;
  const std::size_t instances[] = {instances_before(timeline, begin_ns), instances_before(timeline, behind_ns)};
  const std::size_t messages[] = {messages_before(timeline, begin_ns), messages_before(timeline, behind_ns)};
  const auto moved = [](Index& reference, const std::size_t(&kept)[2]) {
    if (reference == kNone) {
      return;
    }
    reference = reference < kept[0] || reference >= kept[1] ? kNone : static_cast<Index>(reference - kept[0]);
  };
  keep(timeline.instances, instances[0], std::max(instances[0], instances[1]));
  keep(timeline.messages, messages[0], std::max(messages[0], messages[1]));
  for (Instance& instance : timeline.instances) {
    moved(instance.message, messages);
  }
  for (Message& message : timeline.messages) {
    moved(message.publishing_instance, instances);
    moved(message.receiving_instance, instances);
  }
  keep_details(timeline.details, begin_ns, behind_ns, instances, messages);
  timeline.begin_ns = std::max(timeline.begin_ns, begin_ns);
  timeline.end_ns = std::max(timeline.begin_ns, std::min(timeline.end_ns, end_ns));
  cut(timeline.lifecycle, timeline);
  cut(timeline.states, timeline);
}

std::int64_t end_of_first(const Timeline& timeline, std::size_t records) {
  if (timeline.instances.size() + timeline.messages.size() + timeline.states.size() <= records) {
    return timeline.end_ns;
  }
  std::int64_t low = timeline.begin_ns;
  std::int64_t high = timeline.end_ns;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    const std::size_t before =
        instances_before(timeline, middle) + messages_before(timeline, middle) + states_before(timeline, middle);
    const bool fits = before <= records;
    (fits ? low : high) = middle;
  }
  return low;
}

}  // namespace tracing::timeline
