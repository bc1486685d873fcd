// SPDX-License-Identifier: Apache-2.0
// Finds instances of callbacks by thread and time.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/model/timeline/timeline.hpp"

namespace tracing::timeline {

class InstanceIndex {
 public:
  // `instances` are in the order of their starts, and must outlive the index.
  InstanceIndex(const std::vector<Instance>& instances, std::size_t threads);

  // The innermost instance that runs in the thread at a time, or kNone.
  Index running(Index thread, std::int64_t time_ns) const;
  // The instance that begins in the thread at exactly this time, or kNone.
  Index begun(Index thread, std::int64_t time_ns) const;

 private:
  Index last_until(Index thread, std::int64_t time_ns) const;

  const std::vector<Instance>& instances_;
  std::vector<std::vector<Index>> by_thread_;  // in the order of their starts
  std::vector<Index> around_;                  // the instance in which an instance runs, or kNone
};

}  // namespace tracing::timeline
