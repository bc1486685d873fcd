// SPDX-License-Identifier: Apache-2.0
// How long the runs of each callback took, apart from waiting for a processor where the trace tells that.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/model/twin/description/distribution.hpp"
#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

// Callbacks are those of the timeline.
class RunTimes {
 public:
  explicit RunTimes(const Recording& recording);

  std::uint64_t count(std::size_t callback) const { return callbacks_[callback].count; }
  // Of runs that sent something, and of the others. If they do not differ, the first one has all and the second one
  // none.
  Distribution sending(std::size_t callback) const;
  Distribution silent(std::size_t callback) const;
  double blocked(std::size_t callback) const;  // the part in which they needed no processor
  bool has_intra_process(std::size_t callback) const { return callbacks_[callback].intra_process; }
  // When a timer was due first, which may be long before its first call.
  std::int64_t first_due_ns(std::size_t callback, std::int64_t period_ns) const;

 private:
  struct Of {
    std::uint64_t count = 0;
    std::vector<Sample> sending;
    std::vector<Sample> silent;
    std::vector<std::int64_t> starts;
    std::vector<std::int64_t> ends_before;  // of each start: when its thread ended what it ran before; 0: not known
    double work_ns = 0;
    double blocked_ns = 0;
    bool intra_process = false;
  };
  static bool differ(const Of& callback);
  std::vector<Of> callbacks_;
};

}  // namespace tracing::twin
