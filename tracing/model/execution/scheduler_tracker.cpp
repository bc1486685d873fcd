// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/scheduler_tracker.hpp"

#include <algorithm>
#include <map>

namespace tracing {

namespace {

// A thread that was switched off while it could go on: TASK_RUNNING, and what newer kernels record for a preempted one.
constexpr std::int64_t kRunning = 0;
constexpr std::int64_t kPreempted = 0x100;
constexpr std::size_t kTurns = 4'096;  // of a processor that are remembered

std::int64_t number(const Event& event, std::size_t field) {
  return event.field(field).integer().value_or(0);
}

}  // namespace

SchedulerTracker::Plan SchedulerTracker::plan_of(const EventClass& event_class) {
  Plan plan;
  if (event_class.name == "sched_switch") {
    const auto previous_tid = event_class.index_of("prev_tid");
    const auto previous_state = event_class.index_of("prev_state");
    const auto previous_name = event_class.index_of("prev_comm");
    const auto next_tid = event_class.index_of("next_tid");
    if (!previous_tid || !previous_state || !previous_name || !next_tid) {
      return plan;
    }
    plan = {Kind::kSwitch,
            *previous_tid,
            *previous_state,
            *previous_name,
            *next_tid,
            0,
            {},
            event_class.index_of("next_comm")};
  } else if (event_class.name == "sched_wakeup" || event_class.name == "sched_waking" ||
             event_class.name == "sched_wakeup_new") {
    if (const auto tid = event_class.index_of("tid")) {
      plan = {Kind::kWakeup, 0, 0, 0, 0, *tid, event_class.index_of("target_cpu"), {}};
    }
  }
  return plan;
}

void SchedulerTracker::end_turn(std::int64_t cpu, std::int64_t time_ns, std::int64_t tid, std::int64_t next_tid) {
  Processor& processor = processors_[cpu];
  if (processor.turn.begin_ns != 0 && processor.turn.tid == tid) {
    processor.newest.push_back({processor.turn.begin_ns, time_ns, tid});
    if (processor.newest.size() > kTurns) {
      processor.newest.pop_front();
    }
  }
  processor.turn = {time_ns, 0, next_tid};
}

SchedulerTracker::Other SchedulerTracker::longest_on(std::int64_t cpu, std::int64_t begin_ns,
                                                     std::int64_t end_ns) const {
  const auto processor = processors_.find(cpu);
  if (processor == processors_.end()) {
    return {};
  }
  std::map<std::int64_t, std::int64_t> times;
  const auto add = [&](const Turn& turn, std::int64_t turn_end_ns) {
    const std::int64_t ns = std::min(turn_end_ns, end_ns) - std::max(turn.begin_ns, begin_ns);
    if (ns > 0 && turn.tid != 0) {
      times[turn.tid] += ns;
    }
  };
  const std::deque<Turn>& newest = processor->second.newest;
  for (auto turn = newest.rbegin(); turn != newest.rend() && turn->end_ns > begin_ns; ++turn) {
    add(*turn, turn->end_ns);
  }
  if (processor->second.turn.begin_ns != 0) {
    add(processor->second.turn, end_ns);
  }
  Other longest;
  for (const auto& [tid, ns] : times) {
    if (ns > longest.ns) {
      longest = {tid, ns};
    }
  }
  return longest;
}

void SchedulerTracker::change(KernelThread& thread, ThreadInterval::State state, std::int64_t time_ns,
                              const Other& other) {
  if (thread.id && thread.since_ns != 0 && time_ns > thread.since_ns) {
    const auto name = names_.find(other.tid);
    tell_({.state = thread.state,
           .thread = *thread.id,
           .begin_ns = thread.since_ns,
           .end_ns = time_ns,
           .cpu = thread.cpu,
           .other_name = name == names_.end() ? std::string_view() : name->second,
           .other_tid = other.tid,
           .other_ns = other.ns});
  }
  thread.state = state;
  thread.since_ns = time_ns;
}

void SchedulerTracker::set_name(std::int64_t tid, std::string_view name) {
  std::string& known = names_[tid];
  if (known != name) {
    known = name;
  }
}

void SchedulerTracker::on_switch(const Event& event, const Plan& plan, ProcessId process) {
  using State = ThreadInterval::State;
  const std::int64_t previous_tid = number(event, plan.previous_tid);
  const std::int64_t next_tid = number(event, plan.next_tid);
  const std::int64_t cpu = event.cpu_id.value_or(0);
  end_turn(cpu, event.timestamp_ns, previous_tid, next_tid);
  if (previous_tid != 0) {  // the idle thread of each processor has number 0
    set_name(previous_tid, event.field(plan.previous_name).string().value_or(""));
    KernelThread& previous = thread(previous_tid);
    if (!previous.id) {
      previous.id = ThreadId{process, event.vtid.value_or(previous_tid)};
    }
    const std::int64_t state = number(event, plan.previous_state);
    previous.cpu = cpu;
    change(previous, state == kRunning || state == kPreempted ? State::kRunnable : State::kBlocked, event.timestamp_ns,
           {});
  }
  if (next_tid != 0) {
    if (plan.next_name) {
      set_name(next_tid, event.field(*plan.next_name).string().value_or(""));  // it may not have been switched off yet
    }
    KernelThread& next = thread(next_tid);
    // It waited for the processor on which it was, or was woken to run, and may have been moved to another one.
    Other other;
    if (next.state == State::kRunnable && next.id && next.since_ns != 0) {
      other = longest_on(next.cpu, next.since_ns, event.timestamp_ns);
    }
    change(next, State::kRunning, event.timestamp_ns, other);
    next.cpu = cpu;
  }
}

bool SchedulerTracker::on_event(const Event& event, ProcessId process) {
  const std::size_t id = event.event_class->id;
  if (id >= plans_.size()) {
    plans_.resize(id + 1);
  }
  if (!plans_[id]) {
    plans_[id] = plan_of(*event.event_class);
  }
  const Plan& plan = *plans_[id];
  if (plan.kind == Kind::kOther) {
    return false;
  }
  if (plan.kind == Kind::kSwitch) {
    on_switch(event, plan, process);
    return true;
  }
  KernelThread& woken = thread(number(event, plan.tid));
  if (woken.state == ThreadInterval::State::kBlocked) {
    change(woken, ThreadInterval::State::kRunnable, event.timestamp_ns, {});
    if (plan.target_cpu) {
      woken.cpu = number(event, *plan.target_cpu);
    }
  }
  return true;
}

}  // namespace tracing
