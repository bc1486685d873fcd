// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/allocation_counter.hpp"

namespace tracing {

void AllocationCounter::add(std::vector<AllocationCount>& counts, std::size_t id, std::uint64_t bytes) {
  if (id >= counts.size()) {
    counts.resize(id + 1);
  }
  ++counts[id].calls;
  counts[id].bytes += bytes;
}

void AllocationCounter::on_allocation(const Allocation& allocation) {
  add(processes_, allocation.thread.process, allocation.bytes);
  if (allocation.callback == kNoObject) {
    return;
  }
  const ObjectId node = model_.node_of(model_.callbacks()[allocation.callback]);
  if (node != kNoObject) {
    add(nodes_, node, allocation.bytes);
  }
}

}  // namespace tracing
