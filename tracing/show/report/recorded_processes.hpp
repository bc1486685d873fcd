// SPDX-License-Identifier: Apache-2.0
// Counts the events that a trace holds of each process, for a comparison with the events that were fired.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {

class RecordedProcessCounter : public TraceSink {
 public:
  void on_event(const Event& event) override;
  void on_loss(const Loss&) override {}

  // {"processes": [{"vpid": …, "name": …, "seconds": …, "nodes": ["/ns/name", …], "events": {"ros2:rcl_init": 1, …}},
  // …]}. The name is that of the last thread, and the seconds are those from the first event to the last. Events
  // without the context vpid are left out. The reader must still exist.
  std::string json() const;

 private:
  struct Process {
    std::string name;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
    std::set<std::string> nodes;
    std::map<const EventClass*, std::uint64_t> events;
  };

  std::map<std::int64_t, Process> processes_;
};

}  // namespace tracing
