// SPDX-License-Identifier: Apache-2.0
// Counts the memory that is asked for, for each process and within the callbacks of each node.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

struct AllocationCount {
  std::uint64_t calls = 0;  // of malloc and the like
  std::uint64_t bytes = 0;

  AllocationCount operator-(const AllocationCount& earlier) const {
    return {calls - earlier.calls, bytes - earlier.bytes};
  }
};

class AllocationCounter : public ExecutionSink {
 public:
  // The model must outlive this object.
  explicit AllocationCounter(const ObjectModel& model) : model_(model) {}

  void on_allocation(const Allocation& allocation) override;

  // So far, since the begin of the trace.
  AllocationCount of_process(ProcessId process) const { return at(processes_, process); }
  AllocationCount of_node(ObjectId node) const { return at(nodes_, node); }
  bool has_allocations() const { return !processes_.empty(); }

 private:
  static AllocationCount at(const std::vector<AllocationCount>& counts, std::size_t id) {
    return id < counts.size() ? counts[id] : AllocationCount();
  }
  static void add(std::vector<AllocationCount>& counts, std::size_t id, std::uint64_t bytes);

  const ObjectModel& model_;
  std::vector<AllocationCount> processes_;
  std::vector<AllocationCount> nodes_;
};

}  // namespace tracing
