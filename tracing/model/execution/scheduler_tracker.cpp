// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/scheduler_tracker.hpp"

namespace tracing {

namespace {

// A thread that was switched off while it could go on: TASK_RUNNING, and what newer kernels record for a preempted one.
constexpr std::int64_t kRunning = 0;
constexpr std::int64_t kPreempted = 0x100;

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
    plan = {Kind::kSwitch, *previous_tid, *previous_state, *previous_name, *next_tid, 0};
  } else if (event_class.name == "sched_wakeup" || event_class.name == "sched_waking" ||
             event_class.name == "sched_wakeup_new") {
    if (const auto tid = event_class.index_of("tid")) {
      plan = {Kind::kWakeup, 0, 0, 0, 0, *tid};
    }
  }
  return plan;
}

void SchedulerTracker::change(KernelThread& thread, ThreadInterval::State state, std::int64_t time_ns,
                              std::string_view other_name, std::int64_t other_tid) {
  if (thread.id && thread.since_ns != 0 && time_ns > thread.since_ns) {
    sink_.on_thread_state({.state = thread.state,
                           .thread = *thread.id,
                           .begin_ns = thread.since_ns,
                           .end_ns = time_ns,
                           .cpu = thread.cpu,
                           .other_name = other_name,
                           .other_tid = other_tid});
  }
  thread.state = state;
  thread.since_ns = time_ns;
}

void SchedulerTracker::on_switch(const Event& event, const Plan& plan, ProcessId process) {
  using State = ThreadInterval::State;
  const std::int64_t previous_tid = number(event, plan.previous_tid);
  const std::int64_t next_tid = number(event, plan.next_tid);
  const std::int64_t cpu = event.cpu_id.value_or(0);
  if (previous_tid != 0) {  // the idle thread of each processor has number 0
    KernelThread& previous = thread(previous_tid);
    if (!previous.id) {
      previous.id = ThreadId{process, event.vtid.value_or(previous_tid)};
    }
    const std::int64_t state = number(event, plan.previous_state);
    previous.cpu = cpu;
    change(previous, state == kRunning || state == kPreempted ? State::kRunnable : State::kBlocked, event.timestamp_ns,
           {}, 0);
  }
  if (next_tid != 0) {
    KernelThread& next = thread(next_tid);
    next.cpu = cpu;
    const bool waited = next.state == State::kRunnable && previous_tid != 0;
    change(next, State::kRunning, event.timestamp_ns,
           waited ? event.field(plan.previous_name).string().value_or("") : std::string_view(),
           waited ? previous_tid : 0);
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
    change(woken, ThreadInterval::State::kRunnable, event.timestamp_ns, {}, 0);
  }
  return true;
}

}  // namespace tracing
