// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/instance_index.hpp"

#include <algorithm>

namespace tracing::timeline {

InstanceIndex::InstanceIndex(const std::vector<Instance>& instances, std::size_t threads)
    : instances_(instances), by_thread_(threads), around_(instances.size(), kNone) {
  for (std::size_t id = 0; id < instances.size(); ++id) {
    std::vector<Index>& earlier = by_thread_[instances[id].thread];
    if (!earlier.empty()) {
      Index around = earlier.back();
      while (around != kNone && instances[around].end_ns <= instances[id].start_ns) {
        around = around_[around];
      }
      around_[id] = around;
    }
    earlier.push_back(static_cast<Index>(id));
  }
}

// The last instance that begins at `time_ns` or before.
Index InstanceIndex::last_until(Index thread, std::int64_t time_ns) const {
  const std::vector<Index>& ids = by_thread_[thread];
  const auto after = std::upper_bound(ids.begin(), ids.end(), time_ns,
                                      [this](std::int64_t time, Index id) { return time < instances_[id].start_ns; });
  return after == ids.begin() ? kNone : *(after - 1);
}

Index InstanceIndex::running(Index thread, std::int64_t time_ns) const {
  Index id = last_until(thread, time_ns);
  while (id != kNone && instances_[id].end_ns < time_ns) {
    id = around_[id];
  }
  return id;
}

Index InstanceIndex::begun(Index thread, std::int64_t time_ns) const {
  const Index id = last_until(thread, time_ns);
  return id != kNone && instances_[id].start_ns == time_ns ? id : kNone;
}

}  // namespace tracing::timeline
