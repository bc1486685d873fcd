// SPDX-License-Identifier: Apache-2.0
// How long processes take from their start to a node and to the first wait for work, and what the whole system waited
// for. The events of the launcher and of the processes give the times.
//
// A process is "ready" when one of its executors waits or looks for work for the first time: everything that the
// program makes before it spins exists then. ROS 2 has no event for this, and the processes record nothing more for it.
// Where only a session that began after the node has events of executors, as in a dual session, this is unknown.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/analysis/critical_start.hpp"
#include "tracing/model/analysis/launcher_event_list.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/first_activity.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

class StartTracker {
 public:
  void on_event(const Event& event, ProcessId process) {
    note_begin(event);
    const Kind kind = kind_of(*event.event_class);
    if (kind == Kind::kOther ||
        (kind == Kind::kExecutor && process < processes_.size() && processes_[process].is_told)) {
      return;
    }
    on_event(event, process, kind);
  }
  // Fills `starts`, in the order of the launcher's events, `startup` and `launcher_events`. `places`: where each
  // process is in the results.
  void finish(const ProcessTable& processes, const std::vector<std::optional<ProcessIndex>>& places,
              const FirstActivity& first, TraceResults& results) const;
  // As of LauncherEventList.
  void keep_last_launcher_events(std::size_t count) { events_.keep_last(count); }
  std::vector<LauncherEventResult> launcher_events() const { return events_.results(); }
  // When the launcher asked each process to end, or saw that it had ended.
  std::vector<std::pair<ProcessId, std::int64_t>> ends(const ProcessTable& processes) const;

 private:
  // Those of the launcher come first.
  enum class Kind : std::uint8_t {
    kExec,
    kSpawn,
    kCondition,
    kStep,
    kSignal,
    kExit,
    kLaunch,
    kInit,
    kNode,
    kExecutor,
    kOther,
    kUnknown  // not found out yet
  };
  struct Process {
    std::optional<std::int64_t> init_ns;
    std::optional<std::int64_t> node_ns;
    std::optional<std::int64_t> executor_ns;
    bool late = false;       // the trace began after the process
    bool runs_late = false;  // the trace with its executors began after its first node
    bool is_seen = false;    // it has had one of these events
    bool is_told = false;    // no event of an executor tells more
  };
  struct Start {
    StartResult result;
    ProcessId launcher = kNoProcess;
    std::string name;  // as the launch file calls it: "talker"
    std::optional<std::int64_t> end_ns;
  };

  Kind kind_of(const EventClass& event_class) {
    const Kind kind = event_class.id < kinds_.size() ? kinds_[event_class.id] : Kind::kUnknown;
    return kind == Kind::kUnknown ? find_kind(event_class) : kind;
  }
  Kind find_kind(const EventClass& event_class);
  void note_begin(const Event& event) {
    const std::size_t trace = event.event_class->trace;
    if (trace >= begins_.size()) {
      begins_.resize(trace + 1);
    }
    if (!begins_[trace]) {
      begins_[trace] = event.timestamp_ns;
    }
  }
  void on_event(const Event& event, ProcessId process, Kind kind);
  void on_launcher_event(const Event& event, ProcessId launcher, Kind kind);
  void end(ProcessId launcher, const std::string& process, std::int64_t time_ns);
  StartResult result_of(const Start& start, const ProcessTable& processes,
                        const std::vector<std::optional<ProcessIndex>>& places, const FirstActivity& first) const;

  std::vector<Kind> kinds_;  // by EventClass::id, as far as they were needed
  // Times of the launcher's events are those of CLOCK_MONOTONIC until the end.
  std::vector<Start> starts_;
  std::vector<LauncherStep> steps_;
  std::vector<StartCondition> conditions_;
  LauncherEventList events_;
  std::string spawned_;  // the process that the launcher is about to start
  std::optional<std::int64_t> spawn_ns_;
  std::vector<Process> processes_;                   // by ProcessId; may be shorter
  std::vector<std::optional<std::int64_t>> begins_;  // the first event of each trace; may be shorter
  // How far zero of CLOCK_MONOTONIC, the field `time` of the launcher's events, is behind the epoch, at most.
  std::optional<std::int64_t> monotonic_zero_ns_;
};

}  // namespace tracing
