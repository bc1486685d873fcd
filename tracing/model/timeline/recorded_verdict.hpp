// SPDX-License-Identifier: Apache-2.0
// What the verdict of a recording says about what is missing, beside the losses that the packets of the trace tell, and
// about the cost of tracing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/model/analysis/results/field.hpp"

namespace tracing {

struct RecordedVerdict {
  // The cost for one process, as the verdict has estimated it.
  struct ProcessCost {
    std::string name;
    std::int64_t vpid = 0;
    std::uint64_t events = 0;
    double seconds = 0;
    double processor_share = 0;
    std::optional<double> ns_per_callback = {};

    static const Field<ProcessCost> kFields[];
  };
  std::vector<std::string> absences = {};  // sentences: programs and events that were not there, damage
  bool found = false;                      // there is a verdict
  bool damaged = false;  // data are missing that were not counted, so nothing tells how many events were lost
  std::vector<std::string> overwritten = {};  // "12 events overwritten, as asked"; what else the first packets lack
  std::uint64_t discarded_events = 0;         // those that no packet counts are among them
  std::uint64_t lost_packets = 0;
  std::optional<double> ns_per_event = {};  // measured on the machine of the recording; the largest of several
  std::vector<ProcessCost> processes = {};  // from the one with the greatest cost
};
inline constexpr Field<RecordedVerdict::ProcessCost> RecordedVerdict::ProcessCost::kFields[] = {
    {"name", &ProcessCost::name, ""},
    {"vpid", &ProcessCost::vpid, ""},
    {"events", &ProcessCost::events, ""},
    {"seconds", &ProcessCost::seconds, "that tracing took of its threads"},
    {"processor_share", &ProcessCost::processor_share, "of one processor, while it ran", trait::kNotOnPage},
    {"ns_per_callback", &ProcessCost::ns_per_callback,
     "that tracing adds to a callback and what leads to it (`docs/trace_control.md`)"},
};

}  // namespace tracing
