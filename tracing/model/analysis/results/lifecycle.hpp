// SPDX-License-Identifier: Apache-2.0
// The stays of lifecycle nodes in their states.
#pragma once

#include "tracing/model/analysis/results/overview.hpp"

namespace tracing {

struct LifecycleResult {
  ProcessIndex process = 0;
  std::string node;
  std::string state;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool ended = true;
  std::optional<std::uint64_t> allocations = {};
  std::uint64_t allocated_bytes = 0;
  std::uint64_t process_allocations = 0;
  std::uint64_t process_allocated_bytes = 0;

  static const Field<LifecycleResult> kFields[];
};
inline constexpr Field<LifecycleResult> LifecycleResult::kFields[] = {
    {"process", &LifecycleResult::process, "index in `processes`", trait::kProcess},
    {"node", &LifecycleResult::node, ""},
    {"state", &LifecycleResult::state, ""},
    {"begin_ns", &LifecycleResult::begin_ns, "", trait::kTime},
    {"end_ns", &LifecycleResult::end_ns, "", trait::kTime},
    {"ended", &LifecycleResult::ended, "false: the trace ended before"},
    {"allocations", &LifecycleResult::allocations,
     "calls that ask for memory in the callbacks of the node in this time; `null` without events of `lttng_ust_libc`"},
    {"allocated_bytes", &LifecycleResult::allocated_bytes, "that they asked for"},
    {"process_allocations", &LifecycleResult::process_allocations,
     "such calls of the whole process, of which other nodes may be part"},
    {"process_allocated_bytes", &LifecycleResult::process_allocated_bytes, ""},
};

}  // namespace tracing
