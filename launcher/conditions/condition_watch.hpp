// SPDX-License-Identifier: Apache-2.0
// Who tells a launch of the conditions on what its nodes do: a seam with a real (condition_watch_process.hpp) and, in
// tests, a fake implementation.
#pragma once

#include <functional>

#include "tracing/model/conditions/condition_lines.hpp"

namespace launch {

// All calls and callbacks on the thread of the loop.
class ConditionWatch {
 public:
  // Called in a later turn of the loop than what it answers.
  using Tell = std::function<void(const tracing::ConditionReport&)>;

  virtual ~ConditionWatch() = default;

  // To be called before watch().
  virtual void observe(Tell tell) = 0;
  virtual void watch(tracing::ConditionId id, const tracing::LiveCondition& condition) = 0;
  virtual void forget(tracing::ConditionId id) = 0;
  // Nothing is told any more.
  virtual void close() = 0;
};

}  // namespace launch
