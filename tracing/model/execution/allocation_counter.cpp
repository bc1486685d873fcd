// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/allocation_counter.hpp"

#include <algorithm>

namespace tracing {

void AllocationCounter::add(std::vector<AllocationCount>& counts, std::size_t id, std::uint64_t bytes) {
  if (id >= counts.size()) {
    counts.resize(id + 1);
  }
  ++counts[id].calls;
  counts[id].bytes += bytes;
}

void AllocationCounter::on_callback_begin(const CallbackInstance& instance) {
  active_[instance.thread].push_back(instance.callback);
}

void AllocationCounter::on_callback(const CallbackInstance& instance) {
  std::vector<ObjectId>& active = active_[instance.thread];
  const auto innermost = std::find(active.rbegin(), active.rend(), instance.callback);
  if (innermost != active.rend()) {
    active.erase(std::next(innermost).base());
  }
}

void AllocationCounter::on_allocation(const Allocation& allocation) {
  add(processes_, allocation.thread.process, allocation.bytes);
  const std::vector<ObjectId>* const active = active_.find(allocation.thread);
  if (active == nullptr || active->empty()) {
    return;
  }
  const ObjectId node = model_.node_of(model_.callbacks()[active->back()]);
  if (node != kNoObject) {
    add(nodes_, node, allocation.bytes);
  }
}

}  // namespace tracing
