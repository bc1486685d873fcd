// SPDX-License-Identifier: Apache-2.0
// What an agent has to know to record its machine, as bytes: what the launcher has evaluated, and the processes that
// are to start there; and the order for a snapshot. Kernel events and relay daemons are not among it, and no signal to
// the launcher.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "launcher/machines/protocol/wire.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/traced/process_choices.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/session/flight_recorder.hpp"

namespace launch {

struct MachineTrace {
  tracing::TraceConfig config = {};
  ProcessChoices choices = {};
  std::vector<ProcessSpec> processes = {};  // what is known of them tells of their programs, no more
};

std::string to_wire(const MachineTrace& trace);
// Throws WireError.
MachineTrace parse_machine_trace(std::string_view bytes);

std::string to_wire(const tracing::SnapshotOrder& order);
// Throws WireError.
tracing::SnapshotOrder parse_snapshot_order(std::string_view bytes);

}  // namespace launch
