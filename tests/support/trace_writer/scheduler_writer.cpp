// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/scheduler_writer.hpp"

#include <string>

namespace tracing::testing {

void SchedulerWriter::switches(unsigned cpu, std::int64_t time_ns, const Thread& previous, std::int64_t state,
                               const Thread& next) {
  if (!switch_) {
    switch_ = writer_.declare("sched_switch",
                              "\t\tinteger { size = 8; align = 8; signed = 0; encoding = UTF8; } _prev_comm[16];\n"
                              "\t\tinteger { size = 32; align = 8; signed = 1; } _prev_tid;\n"
                              "\t\tinteger { size = 64; align = 8; signed = 1; } _prev_state;\n"
                              "\t\tinteger { size = 8; align = 8; signed = 0; encoding = UTF8; } _next_comm[16];\n"
                              "\t\tinteger { size = 32; align = 8; signed = 1; } _next_tid;\n");
  }
  std::string payload(previous.procname);
  payload.resize(16);
  detail::append(payload, static_cast<std::int32_t>(previous.vtid));
  detail::append(payload, state);
  std::string name(next.procname);
  name.resize(16);
  payload += name;
  detail::append(payload, static_cast<std::int32_t>(next.vtid));
  writer_.write_raw(cpu, time_ns, previous, *switch_, payload);
}

void SchedulerWriter::wakes(unsigned cpu, std::int64_t time_ns, const Thread& waker, const Thread& woken) {
  if (!wakeup_) {
    wakeup_ = writer_.declare("sched_wakeup", "\t\tinteger { size = 32; align = 8; signed = 1; } _tid;\n");
  }
  std::string payload;
  detail::append(payload, static_cast<std::int32_t>(woken.vtid));
  writer_.write_raw(cpu, time_ns, waker, *wakeup_, payload);
}

}  // namespace tracing::testing
