// SPDX-License-Identifier: Apache-2.0
#include "state/object_state.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "counters/stack_tracepoints.hpp"
#include "provider/provider.h"
#include "provider/provider_ext.h"
#include "provider/provider_session.h"

namespace tracetools {
namespace {

template <typename Recorder>
void record(const Recorder& recorder, const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  bool recorded = false;
  for_each_probe(probes, *recorder.tracepoint, [&](const Probe& probe) {
    if (session_of(probe) != session) {
      return;
    }
    recorder(probe, events);
    recorded = true;
  });
  if (recorded) {
    count(recorder.counted);
  }
}

// The tracepoint of an init event that the session records. Null if it records none.
const Tracepoint* recorded_init_tracepoint(const ProbesInUse& probes, const Session* session) {
  for (const StackTracepoint& each : stack_tracepoints()) {
    if (std::string_view(each.group) == "init" && has_probe(probes, *each.tracepoint, session)) {
      return each.tracepoint;
    }
  }
  return nullptr;
}

// The session has a rule for `ros2_session:no_state_dump`. A rule for all events does not count, which also takes
// `ros2_session:any`.
bool wants_no_dump(const ProbesInUse& probes, const Session* session) {
  return has_probe(probes, lttng_ust_tracepoint_ros2_session___no_state_dump, session) &&
         !has_probe(probes, lttng_ust_tracepoint_ros2_session___any, session);
}

// Records ros2_ext:state_dump_begin or state_dump_end into the session alone.
void record_dump_begin(const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  record(TRACETOOLS_RECORDER(ros2_ext, state_dump_begin), probes, session, events);
}

void record_dump_end(const ProbesInUse& probes, const Session* session, std::uint64_t events) {
  record(TRACETOOLS_RECORDER(ros2_ext, state_dump_end), probes, session, events);
}

// Calls the probes of the session at the event's tracepoint.
void record_into(const Session* session, const ProbesInUse& probes, const InitEvent& event) {
  for_each_probe(probes, *event.tracepoint, [&](const Probe& probe) {
    if (session_of(probe) == session) {
      event.record(probe);
    }
  });
  count(event.counted);
}

bool has(const KnownSession& session, const InitEvent& event) {
  const auto dumped = session.dumped.find(event.tracepoint);
  return (dumped != session.dumped.end() && event.number <= dumped->second) ||
         std::find(event.got_live.begin(), event.got_live.end(), session.mark) != event.got_live.end();
}

}  // namespace

ObjectState& ObjectState::instance() {
  static auto* state = new ObjectState;
  return *state;
}

std::size_t ObjectState::HashKey::operator()(const ObjectKey& key) const noexcept {
  return std::hash<const void*>()(key.address) * 31 + static_cast<std::size_t>(key.kind);
}

void ObjectState::keep(InitEvent event) {
  const std::lock_guard lock(mutex_);
  record_live(insert(std::move(event)));
}

void ObjectState::keep_for_dumps(InitEvent event) {
  const std::lock_guard lock(mutex_);
  insert(std::move(event));
}

InitEvent& ObjectState::insert(InitEvent event) {
  if (const auto found = of_object_.find(event.objects.front()); event.name != nullptr && found != of_object_.end()) {
    const auto same = std::find_if(found->second.begin(), found->second.end(), [&](InitEvents::iterator other) {
      return other->name == event.name && other->objects.front() == event.objects.front();
    });
    if (same != found->second.end()) {
      erase(*same);
    }
  }
  event.number = ++last_number_;
  const auto inserted = events_.insert(events_.end(), std::move(event));
  for (const ObjectKey& object : inserted->objects) {
    of_object_[object].push_back(inserted);
  }
  return *inserted;
}

void ObjectState::record_live(InitEvent& event) {
  bool is_reference = false;
  {
    const ProbesInUse probes;
    is_reference = record_live(event, probes);
  }
  if (is_reference) {
    ProbeMark::move_to_end(*event.tracepoint);
  }
}

bool ObjectState::record_live(InitEvent& event, const ProbesInUse& probes) {
  bool recorded = false;
  bool is_reference = false;
  for_each_probe(probes, *event.tracepoint, [&](const Probe& probe) {
    Session* const session = session_of(probe);
    if (session == nullptr) {
      if (probe.data != nullptr) {
        event.record(probe);  // a trigger
      }
      return;
    }
    if (!records(*session)) {
      return;
    }
    event.record(probe);
    recorded = true;
    KnownSession& known = sessions_[session];
    const std::uint32_t mark = known.mark;
    if (known.was_first && known.reference == nullptr) {
      known.reference = event.tracepoint;
      is_reference = true;
    }
    // If the session has just paused, it is unknown whether it has the event. Then a resume will record it again.
    const bool certain = records(*session);
    if (certain && std::find(event.got_live.begin(), event.got_live.end(), mark) == event.got_live.end()) {
      event.got_live.push_back(mark);
    }
  });
  if (recorded) {
    count(event.counted);
  } else {
    count_unrecorded();
  }
  return is_reference;
}

void ObjectState::forget(ObjectKey object) {
  const std::lock_guard lock(mutex_);
  for (auto found = of_object_.find(object); found != of_object_.end(); found = of_object_.find(object)) {
    erase(found->second.back());
  }
}

std::size_t ObjectState::dump_to(Session* session, bool lives) {
  const std::lock_guard lock(mutex_);
  KnownSession* known = nullptr;
  std::vector<const InitEvent*> due;
  {
    const ProbesInUse probes;
    const Tracepoint* const reference = recorded_init_tracepoint(probes, session);
    if (reference == nullptr) {
      if (lives) {
        sessions_[session].was_first = true;
      }
      return 0;
    }
    if (wants_no_dump(probes, session)) {
      return 0;
    }
    known = &sessions_[session];
    const bool asks_again = known->reference != nullptr && ProbeMark::is_after(probes, *known->reference, session);
    known->reference = reference;
    for (const InitEvent& event : events_) {
      if ((asks_again || !has(*known, event)) && has_probe(probes, *event.tracepoint, session)) {
        due.push_back(&event);
      }
    }
    if (!due.empty()) {
      record_dump_begin(probes, session, due.size());
      for (const InitEvent* event : due) {
        record_into(session, probes, *event);
      }
      record_dump_end(probes, session, due.size());
    }
    for (const InitEvent* event : due) {
      known->dumped[event->tracepoint] = last_number_;
    }
  }
  ProbeMark::move_to_end(*known->reference);
  return due.size();
}

void ObjectState::erase(InitEvents::iterator event) {
  for (const ObjectKey& object : event->objects) {
    const auto found = of_object_.find(object);
    if (found == of_object_.end()) {
      continue;  // the event names an object twice
    }
    std::erase(found->second, event);
    if (found->second.empty()) {
      of_object_.erase(found);
    }
  }
  events_.erase(event);
}

}  // namespace tracetools
