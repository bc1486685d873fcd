// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/overview_counter.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

namespace tracing {
namespace {

constexpr const char* kPythonEvent = "lttng_python:event";
constexpr const char* kLoggerField = "logger_name";
// A program may make a logger for each thing that it does. The others are counted together.
constexpr std::size_t kMostLoggers = 200;

}  // namespace

std::uint64_t TraceOverview::lost_events() const {
  std::uint64_t sum = 0;
  for (const LossResult& loss : losses) {
    sum += loss.events;
  }
  return sum;
}

std::uint64_t TraceOverview::lost_packets() const {
  std::uint64_t sum = 0;
  for (const LossResult& loss : losses) {
    sum += loss.packets;
  }
  return sum;
}

bool TraceOverview::lost_uncounted() const {
  return std::any_of(losses.begin(), losses.end(), [](const LossResult& loss) { return loss.uncounted; });
}

void OverviewCounter::count(const Event& event, ProcessId process) {
  const EventClass& event_class = *event.event_class;
  if (event_class.id >= classes_.size()) {
    classes_.resize(event_class.id + 1);
  }
  CountedClass& counted = classes_[event_class.id];
  if (counted.name.empty()) {
    counted.name = event_class.name;
    counted.trace = event_class.trace;
    counted.of_launcher = event_class.name.starts_with("launch:");
    counted.of_python = event_class.name == kPythonEvent;
  }
  // The launcher is no part of the traced system.
  if (counted.of_launcher) {
    ++counted.by_launcher;
    return;
  }
  ++events_;
  if (!begin_ns_) {
    begin_ns_ = event.timestamp_ns;
  }
  end_ns_ = event.timestamp_ns;
  if (process >= counted.by_process.size()) {
    counted.by_process.resize(process + 1);
  }
  ++counted.by_process[process];
  if (counted.of_python) {
    count_logger(event, process);
  }
}

void OverviewCounter::count_logger(const Event& event, ProcessId process) {
  const std::optional<FieldValue> field = event.field(kLoggerField);
  const std::string_view logger = field ? field->string().value_or("") : "";
  std::string name = std::string(kPythonEvent) + " (" + std::string(logger) + ")";
  if (logger.empty() || (loggers_.size() >= kMostLoggers && !loggers_.contains(name))) {
    name = kPythonEvent;
  }
  CountedClass& counted = loggers_[name];
  counted.name = name;
  if (process >= counted.by_process.size()) {
    counted.by_process.resize(process + 1);
  }
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
std::vector<ProcessId> OverviewCounter::processes_that_lost(const CountedLoss& loss) const {
  std::vector<ProcessId> in_trace;
  std::vector<ProcessId> with_the_id;  // a process whose events were all lost has none in the trace
  for (const ProcessId process : order()) {
    const bool has_the_id = !loss.vpid || processes_.processes()[process].vpid == loss.vpid;
    if (!has_the_id) {
      continue;
    }
    with_the_id.push_back(process);
    const bool has_events = std::any_of(classes_.begin(), classes_.end(), [&](const CountedClass& counted) {
      return counted.trace == loss.trace && process < counted.by_process.size() && counted.by_process[process] > 0;
    });
    if (has_events) {
      in_trace.push_back(process);
    }
  }
  return in_trace.empty() && loss.vpid ? with_the_id : in_trace;
}

// The processes that have events, in the order of the overview.
std::vector<ProcessId> OverviewCounter::order() const {
  std::vector<ProcessId> order;
  std::vector<std::string> hosts;
  for (ProcessId process = 0; process < processes_.processes().size(); ++process) {
    hosts.push_back(processes_.host_of(process));
    if (processes_.processes()[process].merged_into != kNoProcess) {
      continue;
    }
    const bool has_events = std::any_of(classes_.begin(), classes_.end(), [&](const CountedClass& counted) {
      return process < counted.by_process.size() && counted.by_process[process] > 0;
    });
    if (has_events) {
      order.push_back(process);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](ProcessId left, ProcessId right) {
    const ProcessObject& a = processes_.processes()[left];
    const ProcessObject& b = processes_.processes()[right];
    return std::tie(hosts[left], a.vpid) < std::tie(hosts[right], b.vpid);
  });
  return order;
}

std::vector<std::optional<ProcessIndex>> OverviewCounter::places() const {
  std::vector<std::optional<ProcessIndex>> places(processes_.processes().size());
  const std::vector<ProcessId> ordered = order();
  for (ProcessIndex place = 0; place < ordered.size(); ++place) {
    places[ordered[place]] = place;
  }
  for (ProcessId process = 0; process < places.size(); ++process) {
    ProcessId shown = process;
    while (processes_.processes()[shown].merged_into != kNoProcess) {
      shown = processes_.processes()[shown].merged_into;
    }
    places[process] = places[shown];
  }
  return places;
}

TraceOverview OverviewCounter::overview() const {
  TraceOverview result;
  result.events = events_;
  if (begin_ns_) {
    result.begin_ns = begin_ns_;
    result.end_ns = end_ns_;
  }
  for (const ProcessId process : order()) {
    const ProcessObject& known = processes_.processes()[process];
    result.processes.push_back({known.vpid, known.name, 0, false, processes_.host_of(process)});
  }
  const std::vector<std::optional<ProcessIndex>> place = places();

  std::map<std::string, EventCount> counts;  // several traces may have classes of one name
  const auto add = [&](const CountedClass& counted) {
    EventCount& count = counts[counted.name];
    count.name = counted.name;
    count.total += counted.by_launcher;
    count.by_process.resize(result.processes.size());
    for (ProcessId process = 0; process < counted.by_process.size(); ++process) {
      if (counted.by_process[process] == 0) {
        continue;
      }
      count.by_process[*place[process]] += counted.by_process[process];
      count.total += counted.by_process[process];
      result.processes[*place[process]].events += counted.by_process[process];
    }
  };
  for (const CountedClass& counted : classes_) {
    if (!counted.name.empty() && !counted.of_python) {
      add(counted);
    }
  }
  for (const auto& [name, counted] : loggers_) {
    add(counted);
  }
  for (auto& [name, count] : counts) {
    result.event_counts.push_back(std::move(count));
  }

  for (const auto& [name, counted] : losses_) {
    LossResult loss = counted.result;
    for (const ProcessId process : processes_that_lost(counted)) {
      loss.processes.push_back(*place[process]);
    }
    std::sort(loss.processes.begin(), loss.processes.end());
    for (const std::size_t process : loss.processes) {
      result.processes[process].doubtful = true;
    }
    result.losses.push_back(std::move(loss));
  }
  return result;
}

}  // namespace tracing
