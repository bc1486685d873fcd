// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tracing::twin {

Simulation::Simulation(const System& system) : system_(system), rules_(system), scheduler_(system.cpus) {
  executors_.resize(system.executors.size());
  for (std::size_t executor = 0; executor < system.executors.size(); ++executor) {
    for (std::size_t count = 0; count < system.executors[executor].threads; ++count) {
      executors_[executor].threads.push_back(scheduler_.add_thread(system.executors[executor].priority));
      threads_.push_back({.executor = executor});
    }
  }
  running_.resize(system.groups.size());
  times_.resize(system.callbacks.size());
  receivers_.resize(system.topics.size());
  callbacks_.reserve(system.callbacks.size());
  const Cycle cycle = system.cycle();
  for (Index index = 0; index < system.callbacks.size(); ++index) {
    const Callback& callback = system.callbacks[index];
    const std::uint64_t seed = system.seed * 40'503 + 7 * index;
    callbacks_.push_back({.queue = {},
                          .due_ns = callback.phase_ns,
                          .delays = Draw(callback.delays, seed, cycle),
                          .near_delays = Draw(callback.near_delays, seed + 2, cycle),
                          .gaps = Draw(callback.gaps, seed + 3, cycle)});
    executors_[system.groups[callback.group].executor].callbacks.push_back(index);
    if (callback.kind == Callback::Kind::kSubscription) {
      receivers_[callback.topic].push_back(index);
    } else if (callback.kind == Callback::Kind::kService) {
      services_[callback.service] = index;
    } else if (callback.kind == Callback::Kind::kClient) {
      answers_[callback.client] = index;
    }
  }
  for (ExecutorState& executor : executors_) {
    std::stable_sort(executor.callbacks.begin(), executor.callbacks.end(), [&](Index left, Index right) {
      return system.callbacks[left].kind < system.callbacks[right].kind;
    });
  }
}

void Simulation::push(Event event) {
  event.number = ++events_;
  queue_.push(event);
}

// From half a usual interval before its first message to as long after its last one.
Simulation::Lifetime Simulation::lifetime_of(const Callback& callback, std::int64_t duration_ns) const {
  const std::vector<Distribution::Moment>& recorded = callback.ways.moments;
  if (recorded.size() < 2) {
    return {0, duration_ns};
  }
  const std::int64_t first_ns = recorded.front().time_ns - system_.begin_ns;
  const std::int64_t last_ns = recorded.back().time_ns - system_.begin_ns;
  const std::int64_t half_ns = (last_ns - first_ns) / static_cast<std::int64_t>(recorded.size() - 1) / 2;
  return {first_ns - half_ns, as_recorded(duration_ns) ? last_ns + half_ns : duration_ns};
}

void Simulation::schedule_timer(Index callback) {
  if (callbacks_[callback].due_ns <= callbacks_[callback].lifetime.end_ns) {
    push({callbacks_[callback].due_ns, 0, Event::Kind::kDue, callback, {}});
  }
}

Figures Simulation::run(std::int64_t duration_ns) {
  up_ns_ = duration_ns > 2 * system_.up_ns ? system_.up_ns : 0;
  is_repeated_ = system_.active_ns > 0 && duration_ns > system_.active_ns;
  for (Index index = 0; index < system_.callbacks.size(); ++index) {
    callbacks_[index].lifetime = lifetime_of(system_.callbacks[index], duration_ns);
    // A timer that never ran was cancelled, or its node ended first.
    if (system_.callbacks[index].kind == Callback::Kind::kTimer && system_.callbacks[index].runs > 0) {
      schedule_timer(index);
    }
  }
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  while (true) {
    const std::int64_t event_ns = queue_.empty() ? kNever : queue_.top().time_ns;
    const std::int64_t step_ns = scheduler_.next_ns().value_or(kNever);
    now_ns_ = std::min(event_ns, step_ns);
    // Of a simulation that ends as the recording did, what was sent at the end still arrives.
    if (now_ns_ == kNever || (now_ns_ > duration_ns && !as_recorded(duration_ns))) {
      return std::move(figures_);
    }
    // What ends at this time does so before anything else begins.
    for (const std::size_t thread : scheduler_.advance(now_ns_)) {
      step_done(thread);
    }
    scheduler_.settle();
    if (event_ns > now_ns_) {
      continue;
    }
    const Event event = queue_.top();
    queue_.pop();
    switch (event.kind) {
      case Event::Kind::kDue: {
        // A thread that waits is woken; one that is busy finds the timer when it looks next.
        const bool is_woken = could_run(event.what);
        const Draw::Drawn late = is_woken ? callbacks_[event.what].delays.next_at(now_ns_) : Draw::Drawn();
        callbacks_[event.what].way = {SimulatedTime::Source::kDelay, late.place};
        push({now_ns_ + late.value, 0, Event::Kind::kTimer, event.what, {}});
        break;
      }
      case Event::Kind::kTimer: {
        callbacks_[event.what].is_due = true;
        const std::size_t executor = system_.groups[system_.callbacks[event.what].group].executor;
        if (system_.executors[executor].kind == Executor::Kind::kEvents) {
          executors_[executor].ready.push_back(event.what);
        }
        look(executor, std::nullopt);
        break;
      }
      case Event::Kind::kArrival:
        arrive(event.what, event.message);
        break;
      case Event::Kind::kWake:
        work(event.what, 0, false);
        break;
    }
  }
}

bool Simulation::could_run(Index callback) const {
  const Index group = system_.callbacks[callback].group;
  if (!system_.groups[group].reentrant && running_[group] > 0) {
    return false;
  }
  const std::vector<std::size_t>& threads = executors_[system_.groups[group].executor].threads;
  return std::any_of(threads.begin(), threads.end(),
                     [&](std::size_t thread) { return threads_[thread].callback == kNone; });
}

void Simulation::arrive(Index index, Message message) {
  const Callback& callback = system_.callbacks[index];
  std::deque<Message>& queue = callbacks_[index].queue;
  queue.push_back(message);
  const std::size_t executor = system_.groups[callback.group].executor;
  if (callback.kind == Callback::Kind::kSubscription && callback.qos.depth > 0 && queue.size() > callback.qos.depth) {
    queue.pop_front();
  } else if (system_.executors[executor].kind == Executor::Kind::kEvents) {
    executors_[executor].ready.push_back(index);
  }
  look(executor, std::nullopt);
}

bool Simulation::is_ready(Index callback) const {
  const Index group = system_.callbacks[callback].group;
  return (callbacks_[callback].is_due || !callbacks_[callback].queue.empty()) &&
         (system_.groups[group].reentrant || running_[group] == 0);
}

std::optional<Index> Simulation::next(ExecutorState& executor) {
  const bool collects = system_.executors[threads_[executor.threads.front()].executor].kind != Executor::Kind::kEvents;
  for (int attempt = 0; attempt < 2; ++attempt) {
    while (!executor.ready.empty()) {
      const Index callback = executor.ready.front();
      executor.ready.pop_front();
      if (is_ready(callback)) {
        return callback;
      }
    }
    if (!collects || attempt > 0) {
      break;
    }
    std::copy_if(executor.callbacks.begin(), executor.callbacks.end(), std::back_inserter(executor.ready),
                 [&](Index callback) { return is_ready(callback); });
  }
  return std::nullopt;
}

void Simulation::look(std::size_t executor, std::optional<std::size_t> ended) {
  ExecutorState& state = executors_[executor];
  if (ended) {
    if (const auto callback = next(state)) {
      take(*ended, *callback, true);
    }
  }
  for (const std::size_t thread : state.threads) {
    if (threads_[thread].callback != kNone) {
      continue;
    }
    const auto callback = next(state);
    if (!callback) {
      return;
    }
    take(thread, *callback, false);
  }
}

void Simulation::take(std::size_t index, Index callback, bool goes_on) {
  Thread& thread = threads_[index];
  CallbackState& state = callbacks_[callback];
  thread.callback = callback;
  thread.step = 0;
  thread.worked_ns = 0;
  thread.slept = false;
  ++running_[system_.callbacks[callback].group];
  if (state.is_due) {
    state.is_due = false;
    thread.message = {state.due_ns, kNone, kNone, 0, state.way};
    // As rcl does: periods that have passed altogether are left out.
    const std::int64_t period = system_.callbacks[callback].period_ns;
    state.due_ns += period;
    if (state.due_ns < now_ns_) {
      state.due_ns += ((now_ns_ - state.due_ns) / period + 1) * period;
    }
    schedule_timer(callback);
  } else {
    thread.message = state.queue.front();
    state.queue.pop_front();
  }
  std::int64_t gap_ns = 0;
  if (goes_on) {
    const Draw::Drawn gap = state.gaps.next_at(now_ns_);
    gap_ns = gap.value;
    thread.message.way = {SimulatedTime::Source::kGap, gap.place};
  }
  work(index, gap_ns, goes_on);
}

void Simulation::work(std::size_t thread, std::int64_t work_ns, bool goes_on) {
  if (goes_on) {
    scheduler_.go_on(thread, work_ns);
  } else {
    scheduler_.add_work(thread, work_ns, now_ns_);
  }
}

// How much of its work a run has done when it sends, or at its end.
std::int64_t Simulation::work_until(const Thread& thread, std::size_t step) const {
  const Callback& callback = system_.callbacks[thread.callback];
  const double all = static_cast<double>(thread.run.time_ns) * (1 - callback.blocked);
  if (step > thread.run.outputs.size()) {
    return std::llround(all);
  }
  return std::llround(all * callback.outputs[thread.run.outputs[step - 1]].sent);
}

void Simulation::step_done(std::size_t index) {
  Thread& thread = threads_[index];
  const Callback& callback = system_.callbacks[thread.callback];
  if (thread.step == 0) {
    thread.begin_ns = now_ns_;
    thread.run = rules_.next_run(thread.callback, now_ns_);
    const Message& message = thread.message;
    const bool counted = counts(message.sent_ns);
    if (counted) {
      times_[thread.callback].ways.push_back(
          {message.way.source, message.way.place, now_ns_ - message.sent_ns, message.sent_ns});
    }
    if (counted && callback.kind == Callback::Kind::kSubscription) {
      const std::string& node = system_.nodes[system_.publishers[message.publisher].node].name;
      figures_[{FigureKind::kHop, hop_name(node, callback.name)}].push_back(now_ns_ - message.sent_ns);
    } else if (callback.kind == Callback::Kind::kClient && counts(message.requested_ns)) {
      const Client& client = system_.clients[callback.client];
      figures_[{FigureKind::kCall, call_name(system_.nodes[client.node].name, client.service)}].push_back(
          now_ns_ - message.requested_ns);
    }
  } else if (thread.step > thread.run.outputs.size()) {
    const auto sleep_ns = static_cast<std::int64_t>(static_cast<double>(thread.run.time_ns) * callback.blocked);
    if (sleep_ns > 0 && !thread.slept) {
      thread.slept = true;
      push({now_ns_ + sleep_ns, 0, Event::Kind::kWake, index, {}});
      return;
    }
    end(index);
    return;
  }
  const std::size_t done = thread.step++;
  const std::int64_t until_ns = work_until(thread, thread.step);
  work(index, until_ns - thread.worked_ns, true);
  thread.worked_ns = std::max(thread.worked_ns, until_ns);
  if (done > 0) {
    const Output& output = callback.outputs[thread.run.outputs[done - 1]];
    for (std::size_t count = 0; count < output.times; ++count) {
      send(output);
    }
  }
}

void Simulation::send(const Output& output) {
  const auto process_of = [&](Index callback) {
    return system_.nodes[system_.groups[system_.callbacks[callback].group].node].process;
  };
  const auto deliver = [&](Index callback, Message message) {
    CallbackState& state = callbacks_[callback];
    if (now_ns_ < state.lifetime.begin_ns || now_ns_ > state.lifetime.end_ns) {
      return;
    }
    const bool is_near = !system_.callbacks[callback].near_delays.empty() && message.publisher != kNone &&
                         system_.nodes[system_.publishers[message.publisher].node].process == process_of(callback);
    const Draw::Drawn delay = (is_near ? state.near_delays : state.delays).next_at(now_ns_);
    message.way = {is_near ? SimulatedTime::Source::kNearDelay : SimulatedTime::Source::kDelay, delay.place};
    state.last_ns = std::max(state.last_ns, now_ns_ + delay.value);
    push({state.last_ns, 0, Event::Kind::kArrival, callback, message});
  };
  if (output.publisher != kNone) {
    for (const Index callback : receivers_[system_.publishers[output.publisher].topic]) {
      deliver(callback, {now_ns_, output.publisher, kNone, 0});
    }
  } else if (const auto service = services_.find(system_.clients[output.client].service); service != services_.end()) {
    deliver(service->second, {now_ns_, kNone, output.client, now_ns_});
  }
}

void Simulation::end(std::size_t index) {
  Thread& thread = threads_[index];
  const Callback& callback = system_.callbacks[thread.callback];
  if (counts(thread.begin_ns)) {
    figures_[{FigureKind::kCallback, callback.name}].push_back(now_ns_ - thread.begin_ns);
    times_[thread.callback].runs.push_back(
        {thread.run.is_silent ? SimulatedTime::Source::kSilentRun : SimulatedTime::Source::kRun, thread.run.place,
         now_ns_ - thread.begin_ns, thread.begin_ns});
  }
  --running_[callback.group];
  if (callback.kind == Callback::Kind::kService) {
    if (const auto answer = answers_.find(thread.message.client); answer != answers_.end()) {
      CallbackState& state = callbacks_[answer->second];
      Message response = thread.message;
      response.sent_ns = now_ns_;
      const Draw::Drawn delay = state.delays.next_at(now_ns_);
      response.way = {SimulatedTime::Source::kDelay, delay.place};
      push({now_ns_ + delay.value, 0, Event::Kind::kArrival, answer->second, response});
    }
  }
  thread.callback = kNone;
  // A group is that of one executor only, so nobody else waits for its end.
  look(thread.executor, index);
}

}  // namespace tracing::twin
