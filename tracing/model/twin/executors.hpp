// SPDX-License-Identifier: Apache-2.0
// Which threads are those of one executor, and which callbacks exclude one another. A trace of CARET tells both. Of
// others both follow from what ran when.
//
// - Of the threads of one executor only one at a time waits for work. Threads of a process that have waited at the same
//   time are of two executors; others are of one, and so are those that ran the same callback.
// - Callbacks of one node that ran at the same time are in different groups, and a callback that ran twice at the same
//   time is in a reentrant one. Others of the same node and executor are taken for mutually exclusive.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

struct FoundExecutor {
  timeline::Index process = timeline::kNone;
  std::vector<std::int64_t> threads;  // their vtid
  bool waits = false;                 // it tells when it waits; an EventsExecutor does not
  std::string recorded_kind;          // as timeline::Executor::kind; empty: the trace does not tell
};

struct FoundGroup {
  timeline::Index node = timeline::kNone;
  std::size_t executor = 0;
  bool reentrant = false;
};

struct FoundExecutors {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<FoundExecutor> executors;
  std::vector<FoundGroup> groups;
  std::vector<std::size_t> executor_of;  // by callback of the timeline; kNone: it never ran
  std::vector<std::size_t> group_of;     // likewise
};

FoundExecutors find_executors(const Recording& recording);

}  // namespace tracing::twin
