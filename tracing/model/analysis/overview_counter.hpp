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
  OverviewCounter() = default;
  OverviewCounter(const OverviewCounter&) = delete;  // its parts refer to one another
  OverviewCounter& operator=(const OverviewCounter&) = delete;

  void on_event(const Event& event) override { count(event); }
  void on_loss(const Loss& loss) override;

  // Nobody knows which processes had the events that are missing.
  void doubt_all() { doubts_all_ = true; }
  TraceOverview overview() const;

  // For one that also needs the process of each event: counts the event and returns its process. kNoProcess: it is the
  // copy that another session has recorded, or its process is in doubt (ProcessTable::is_in_doubt()).
  [[gnu::always_inline]] ProcessId count(const Event& event) {
    const ProcessId process = processes_.usual_of(event);
    if (process == kNoProcess) [[unlikely]] {
      return count_after_search(event);
    }
    count(event, process);
    return process;
  }
  [[gnu::noinline]] ProcessId count_after_search(const Event& event) {
    const ProcessId process = processes_.of(event);
    if (processes_.is_copy(event, process)) {
      return kNoProcess;
    }
    count(event, process);
    return processes_.is_in_doubt(process) ? kNoProcess : process;
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
    if (id < usual_.size() && process < usual_[id].processes) [[likely]] {
      end_ns_ = event.timestamp_ns;
      ++usual_[id].by_process[process];
      return;
    }
    count_unusual(event, process);
  }
  void count_unusual(const Event& event, ProcessId process);
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

  // The counts of a class for processes that had such events before, if there is nothing else to be done.
  struct UsualClass {
    std::uint64_t* by_process = nullptr;  // those of the class in classes_
    std::size_t processes = 0;
  };
  std::vector<UsualClass> usual_;  // by EventClass::id; may be shorter
  std::optional<std::int64_t> begin_ns_;
  std::int64_t end_ns_ = 0;
  ProcessTable processes_;
  std::vector<CountedClass> classes_;            // by EventClass::id
  std::map<std::string, CountedClass> loggers_;  // by the name in the overview
  std::map<std::string, CountedLoss> losses_;    // by stream
  bool doubts_all_ = false;
};

}  // namespace tracing
