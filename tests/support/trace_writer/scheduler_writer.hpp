// SPDX-License-Identifier: Apache-2.0
// Writes the events of the kernel's scheduler, as LTTng's modules record them, to a trace of TraceWriter.
#pragma once

#include <cstdint>
#include <optional>

#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing::testing {

class SchedulerWriter {
 public:
  // The writer must outlive this object.
  explicit SchedulerWriter(TraceWriter& writer) : writer_(writer) {}

  // sched_switch on a processor. `state` is that of the previous thread: 0 when it could go on, 1 when it sleeps.
  void switches(unsigned cpu, std::int64_t time_ns, const Thread& previous, std::int64_t state, const Thread& next);
  // sched_wakeup
  void wakes(unsigned cpu, std::int64_t time_ns, const Thread& waker, const Thread& woken);

 private:
  TraceWriter& writer_;
  std::optional<std::uint16_t> switch_;
  std::optional<std::uint16_t> wakeup_;
};

}  // namespace tracing::testing
