// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/overview_counter.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <tuple>

namespace tracing {
namespace {

constexpr const char* kPythonEvent = "lttng_python:event";
constexpr const char* kLoggerField = "logger_name";
// A program may make a logger for each thing that it does. The others are counted together.
constexpr std::size_t kMostLoggers = 200;

// "kworker" of "kworker/0:1", "ksoftirqd" of "ksoftirqd/1": the kernel's threads are numbered.
std::string group_name(const std::string& name) {
  return name.substr(0, name.find_first_of("/:"));
}

}  // namespace

std::uint64_t TraceOverview::folded_processes() const {
  std::uint64_t sum = 0;
  for (const ProcessResult& process : processes) {
    sum += process.folded;
  }
  return sum;
}

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

void OverviewCounter::count_unusual(const Event& event, ProcessId process) {
  const std::size_t id = event.event_class->id;
  CountedClass& counted = id < classes_.size() && classes_[id].is_known ? classes_[id] : new_class(*event.event_class);
  // The launcher is no part of the traced system.
  if (counted.of_launcher) {
    ++counted.by_launcher;
    return;
  }
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
    return;
  }
  usual_.resize(classes_.size());
  usual_[id] = {counted.by_process.data(), counted.by_process.size()};
}

OverviewCounter::CountedClass& OverviewCounter::new_class(const EventClass& event_class) {
  if (event_class.id >= classes_.size()) {
    classes_.resize(event_class.id + 1);
  }
  CountedClass& counted = classes_[event_class.id];
  counted.is_known = true;
  counted.name = event_class.name;
  counted.trace = event_class.trace;
  counted.of_launcher = event_class.name.starts_with("launch:");
  counted.of_python = event_class.name == kPythonEvent;
  return counted;
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
  for (const Row& row : rows()) {
    for (const ProcessId process : row.processes) {
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
  }
  return in_trace.empty() && loss.vpid ? with_the_id : in_trace;
}

// The processes that have events, in the order of the overview.
std::vector<OverviewCounter::Row> OverviewCounter::rows() const {
  const std::size_t count = processes_.processes().size();
  std::vector<bool> has_events(count);
  std::vector<bool> has_own_events(count);
  for (const CountedClass& counted : classes_) {
    const bool of_kernel = counted.name.find(':') == std::string::npos;  // the others have a provider
    for (ProcessId process = 0; process < std::min(count, counted.by_process.size()); ++process) {
      if (counted.by_process[process] > 0) {
        has_events[process] = true;
        has_own_events[process] = has_own_events[process] || !of_kernel;
      }
    }
  }
  std::vector<Row> rows;
  std::map<std::pair<std::string, std::string>, std::vector<ProcessId>> of_kernel;  // by host and name
  for (ProcessId process = 0; process < count; ++process) {
    const ProcessObject& known = processes_.processes()[process];
    if (known.merged_into != kNoProcess || !has_events[process]) {
      continue;
    }
    if (has_own_events[process]) {
      rows.push_back({{process}, known.name, processes_.host_of(process), false});
    } else {
      of_kernel[{processes_.host_of(process), group_name(known.name)}].push_back(process);
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& left, const Row& right) {
    const auto& vpid = [this](const Row& row) { return processes_.processes()[row.processes.front()].vpid; };
    return std::tuple(left.host, vpid(left)) < std::tuple(right.host, vpid(right));
  });
  for (auto& [host_and_name, processes] : of_kernel) {
    const bool is_one = processes.size() == 1;
    const std::string name = is_one ? processes_.processes()[processes.front()].name : host_and_name.second;
    rows.push_back({std::move(processes), name, host_and_name.first, true});
  }
  return rows;
}

std::vector<std::optional<ProcessIndex>> OverviewCounter::places() const {
  std::vector<std::optional<ProcessIndex>> places(processes_.processes().size());
  const std::vector<Row> ordered = rows();
  for (ProcessIndex place = 0; place < ordered.size(); ++place) {
    for (const ProcessId process : ordered[place].processes) {
      places[process] = place;
    }
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
  for (const CountedClass& counted : classes_) {
    result.events += std::accumulate(counted.by_process.begin(), counted.by_process.end(), std::uint64_t{0});
  }
  if (begin_ns_) {
    result.begin_ns = begin_ns_;
    result.end_ns = end_ns_;
  }
  for (const Row& row : rows()) {
    ProcessResult process{.name = row.name, .host = row.host};
    process.doubtful = doubts_all_;
    process.folded = row.of_kernel_alone ? row.processes.size() : 0;
    if (row.processes.size() == 1) {
      process.vpid = processes_.processes()[row.processes.front()].vpid;
    }
    result.processes.push_back(std::move(process));
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
    loss.processes.erase(std::unique(loss.processes.begin(), loss.processes.end()), loss.processes.end());
    for (const std::size_t process : loss.processes) {
      result.processes[process].doubtful = true;
    }
    result.losses.push_back(std::move(loss));
  }
  return result;
}

}  // namespace tracing
