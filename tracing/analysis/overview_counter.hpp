// SPDX-License-Identifier: Apache-2.0
// Counts the events of a trace by name and process, and adds up its losses.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "tracing/analysis/results.hpp"
#include "tracing/reader/trace_reader.hpp"

namespace tracing {

class OverviewCounter : public TraceSink {
 public:
  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;

  TraceOverview overview() const;

 private:
  struct Process {
    std::optional<std::int64_t> vpid;
    std::string name;
    bool named_by_main_thread = false;
  };
  struct CountedClass {
    std::string name;
    std::size_t trace = 0;
    std::vector<std::uint64_t> by_process;  // in the order of processes_
  };
  struct CountedLoss {
    LossResult result;
    std::size_t trace = 0;
    std::optional<std::int64_t> vpid;
  };

  std::size_t process_of(const Event& event);
  std::vector<std::size_t> processes_that_lost(const CountedLoss& loss) const;

  std::uint64_t events_ = 0;
  std::optional<std::int64_t> begin_ns_;
  std::int64_t end_ns_ = 0;
  std::vector<Process> processes_;
  std::unordered_map<std::int64_t, std::size_t> process_index_;
  std::optional<std::size_t> without_vpid_;
  std::optional<std::int64_t> last_vpid_;  // consecutive events often come from one process
  std::size_t last_process_ = 0;
  std::vector<CountedClass> classes_;          // by EventClass::id
  std::map<std::string, CountedLoss> losses_;  // by stream
};

}  // namespace tracing
