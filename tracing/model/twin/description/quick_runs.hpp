// SPDX-License-Identifier: Apache-2.0
// The runs of callbacks with simple rules, drawn beforehand.
//
// OutputRules touches much memory, which is in no cache when a callback runs after some milliseconds: several
// microseconds, as much as whole callbacks take. Here a run touches a few lines, and takes no lock.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracing/model/twin/description/distribution.hpp"
#include "tracing/model/twin/description/twin_system.hpp"

namespace tracing::twin {

class QuickRuns {
 public:
  explicit QuickRuns(const System& system);

  // Whether it knows the runs of the callback: all of its outputs are sent in each run, or all of them when the same
  // inputs are complete. OutputRules must not be asked for them.
  bool knows(Index callback) const { return of_[callback].is_known; }

  struct Run {
    std::int64_t time_ns = 0;
    const std::vector<std::size_t>* outputs = nullptr;  // indices in Callback::outputs, by `sent`; null: none
  };
  Run next(Index callback);

 private:
  struct Join {
    std::uint64_t all = 0;
    std::atomic<std::uint64_t> seen{0};
  };
  struct Times {
    std::vector<std::int64_t> values;
    std::atomic<std::size_t> used{0};
    std::int64_t next() {
      return values.empty() ? 0 : values[used.fetch_add(1, std::memory_order_relaxed) % values.size()];
    }
  };
  struct Of {
    bool is_known = false;
    Join* join = nullptr;  // that it is an input of
    std::uint64_t bit = 0;
    Times times;  // of runs that send something; of all if there are no silent ones
    Times silent;
    std::vector<std::size_t> outputs;
  };

  std::vector<Of> of_;  // by callback
  std::vector<Join> joins_;
};

}  // namespace tracing::twin
