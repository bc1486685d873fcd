// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/overview_counter.hpp"

#include <algorithm>
#include <numeric>

namespace tracing {

std::uint64_t TraceOverview::lost_events() const {
  std::uint64_t sum = 0;
  for (const LossResult& loss : losses) sum += loss.events;
  return sum;
}

std::uint64_t TraceOverview::lost_packets() const {
  std::uint64_t sum = 0;
  for (const LossResult& loss : losses) sum += loss.packets;
  return sum;
}

bool TraceOverview::lost_uncounted() const {
  return std::any_of(losses.begin(), losses.end(), [](const LossResult& loss) { return loss.uncounted; });
}

std::size_t OverviewCounter::process_of(const Event& event) {
  if (!event.vpid) {
    if (!without_vpid_) {
      without_vpid_ = processes_.size();
      processes_.emplace_back();
    }
    return *without_vpid_;
  }
  if (last_vpid_ != event.vpid) {
    const auto [found, is_new] = process_index_.try_emplace(*event.vpid, processes_.size());
    if (is_new) processes_.push_back({event.vpid, "", false});
    last_vpid_ = event.vpid;
    last_process_ = found->second;
  }
  // procname is the name of the thread: only the main thread has the name of the process.
  Process& process = processes_[last_process_];
  if (!process.named_by_main_thread && event.procname) {
    process.named_by_main_thread = event.vtid == event.vpid;
    if (process.named_by_main_thread || process.name.empty()) process.name = *event.procname;
  }
  return last_process_;
}

void OverviewCounter::on_event(const Event& event) {
  // The launcher's own events are no part of the traced system.
  if (event.event_class->name.starts_with("launch:")) return;
  ++events_;
  if (!begin_ns_) begin_ns_ = event.timestamp_ns;
  end_ns_ = event.timestamp_ns;

  const std::size_t process = process_of(event);
  const EventClass& event_class = *event.event_class;
  if (event_class.id >= classes_.size()) classes_.resize(event_class.id + 1);
  CountedClass& counted = classes_[event_class.id];
  if (counted.by_process.empty()) {
    counted.name = event_class.name;
    counted.trace = event_class.trace;
  }
  if (process >= counted.by_process.size()) counted.by_process.resize(process + 1);
  ++counted.by_process[process];
}

void OverviewCounter::on_loss(const Loss& loss) {
  CountedLoss& counted = losses_[loss.stream->name];
  counted.result.stream = loss.stream->name;
  counted.trace = loss.stream->trace;
  counted.vpid = loss.stream->vpid;
  if (!loss.count) {
    counted.result.uncounted = true;
  } else if (loss.kind == Loss::Kind::kEvents) {
    counted.result.events += *loss.count;
  } else {
    counted.result.packets += *loss.count;
  }
  if (loss.begin_ns && (!counted.result.begin_ns || *loss.begin_ns < *counted.result.begin_ns)) {
    counted.result.begin_ns = loss.begin_ns;
  }
  if (loss.end_ns && (!counted.result.end_ns || *loss.end_ns > *counted.result.end_ns)) {
    counted.result.end_ns = loss.end_ns;
  }
}

// Buffers per process show which process lost events. Buffers per user are shared: any process of the trace may have
// lost events in them.
std::vector<std::size_t> OverviewCounter::processes_that_lost(const CountedLoss& loss) const {
  std::vector<std::size_t> found;
  for (std::size_t process = 0; process < processes_.size(); ++process) {
    const bool in_trace = std::any_of(classes_.begin(), classes_.end(), [&](const CountedClass& counted) {
      return counted.trace == loss.trace && process < counted.by_process.size() && counted.by_process[process] > 0;
    });
    const bool may_have = loss.vpid ? processes_[process].vpid == loss.vpid : in_trace;
    if (may_have) found.push_back(process);
  }
  return found;
}

TraceOverview OverviewCounter::overview() const {
  TraceOverview result;
  result.events = events_;
  if (begin_ns_) {
    result.begin_ns = begin_ns_;
    result.end_ns = end_ns_;
  }

  std::vector<std::size_t> order(processes_.size());  // maps a place in the result to the place here
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [this](std::size_t left, std::size_t right) { return processes_[left].vpid < processes_[right].vpid; });
  std::vector<std::size_t> place(processes_.size());  // maps the other way
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    result.processes.push_back({processes_[order[i]].vpid, processes_[order[i]].name, 0, false});
  }

  std::map<std::string, EventCount> counts;  // several traces may have classes of one name
  for (const CountedClass& counted : classes_) {
    if (counted.by_process.empty()) continue;  // an event of the launcher
    EventCount& count = counts[counted.name];
    count.name = counted.name;
    count.by_process.resize(processes_.size());
    for (std::size_t process = 0; process < counted.by_process.size(); ++process) {
      count.by_process[place[process]] += counted.by_process[process];
      count.total += counted.by_process[process];
      result.processes[place[process]].events += counted.by_process[process];
    }
  }
  for (auto& [name, count] : counts) result.event_counts.push_back(std::move(count));

  for (const auto& [name, counted] : losses_) {
    LossResult loss = counted.result;
    for (const std::size_t process : processes_that_lost(counted)) loss.processes.push_back(place[process]);
    std::sort(loss.processes.begin(), loss.processes.end());
    for (const std::size_t process : loss.processes) result.processes[process].doubtful = true;
    result.losses.push_back(std::move(loss));
  }
  return result;
}

}  // namespace tracing
