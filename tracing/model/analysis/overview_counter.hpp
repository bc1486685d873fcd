// SPDX-License-Identifier: Apache-2.0
// Counts the events of a trace by name and process, and adds up its losses. What Python programs log is one event of
// LTTng; it is counted by logger.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

class OverviewCounter : public TraceSink {
 public:
  void on_event(const Event& event) override { count(event); }
  void on_loss(const Loss& loss) override;

  TraceOverview overview() const;

  // For one that also needs the process of each event: counts the event and returns its process. kNoProcess: it is the
  // copy that another session has recorded.
  ProcessId count(const Event& event) {
    const ProcessId process = processes_.of(event);
    if (processes_.is_copy(event, process)) {
      return kNoProcess;
    }
    count(event, process);
    return process;
  }
  const ProcessTable& processes() const { return processes_; }
  // Where each process is in the processes of the overview; nullopt when it is not there. Processes that the kernel's
  // events alone show stand behind the others, those of one name at one place: a machine has thousands.
  std::vector<std::optional<ProcessIndex>> places() const;

 private:
  struct CountedClass {
    std::string name;
    bool is_known = false;
    bool of_launcher = false;
    bool of_python = false;
    std::uint64_t by_launcher = 0;
    std::size_t trace = 0;
    std::vector<std::uint64_t> by_process;  // in the order of processes_
  };
  struct CountedLoss {
    LossResult result;
    std::size_t trace = 0;
    std::optional<std::int64_t> vpid;
  };

  void count(const Event& event, ProcessId process) {
    const std::size_t id = event.event_class->id;
    CountedClass& counted =
        id < classes_.size() && classes_[id].is_known ? classes_[id] : new_class(*event.event_class);
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
  CountedClass& new_class(const EventClass& event_class);
  void count_logger(const Event& event, ProcessId process);
  // A process of the overview.
  struct Row {
    std::vector<ProcessId> processes;  // one, or those of a name that the kernel's events alone show
    std::string name;
    std::string host;
    bool of_kernel_alone = false;
  };
  std::vector<Row> rows() const;
  std::vector<ProcessId> processes_that_lost(const CountedLoss& loss) const;

  std::uint64_t events_ = 0;
  std::optional<std::int64_t> begin_ns_;
  std::int64_t end_ns_ = 0;
  ProcessTable processes_;
  std::vector<CountedClass> classes_;            // by EventClass::id
  std::map<std::string, CountedClass> loggers_;  // by the name in the overview
  std::map<std::string, CountedLoss> losses_;    // by stream
};

}  // namespace tracing
